"""Halves: the clock, the end of a half, change of sides, full time."""

import pytest

from schemas.errors import TouchlineError
from schemas.game import EventKind, Phase
from schemas.rule_book import load_rule_book
from schemas.side import Side


def test_the_clock_runs_from_the_first_start_also_through_stoppages(new_bench):
    bench = new_bench(duration=200.0)
    bench.until(lambda state: state.running)
    assert bench.state.clock == 0.0
    bench.playing()
    bench.ask("stop")
    before = bench.state.clock
    bench.run(3.0)
    assert bench.state.phase is Phase.STOPPED and bench.state.clock - before == pytest.approx(3.0)


@pytest.mark.parametrize("halted", [False, True])
def test_a_half_ends_at_once_when_its_time_is_up(new_bench, halted):
    bench = new_bench(duration=10.0)
    bench.playing()
    if halted:
        bench.ask("stop")
    bench.until(lambda state: state.phase is Phase.PARKING)
    assert bench.state.clock == pytest.approx(5.0)
    assert (bench.events[-1].kind, bench.events[-1].rule) == (EventKind.HALF_TIME, "half_end")


def test_without_a_duration_a_half_lasts_as_the_rule_book_says(new_bench):
    bench = new_bench(rules="friendly")
    assert bench.state.timing.limit == load_rule_book("friendly").periods.half_duration


def test_after_the_break_sides_are_changed_and_the_other_side_kicks_off(bench):
    bench.playing()
    bench.ask("end_half")
    ended = bench.events[-1].time
    clock = bench.state.clock
    bench.robots["cyan2"] = (3.0, 3.0)
    bench.until(lambda state: state.phase is Phase.KICK_OFF)
    state = bench.state
    pause = bench.book.periods.parking + bench.book.periods.half_time_break
    assert bench.events[-1].time - ended == pytest.approx(pause)
    assert (state.half, state.cyan_attacks, state.side, state.clock) == (2, -1, Side.MAGENTA, clock)
    for name, pose in bench.starts.items():
        assert bench.robots[name] == pytest.approx((-pose.x, -pose.y))
    bench.until(lambda state: state.running)
    assert bench.events[-1].time - ended < pause + bench.book.restarts.signal_to_start + 1


def test_carried_robots_face_the_direction_they_attack(bench):
    bench.playing()
    bench.ask("end_half")
    periods = bench.book.periods
    rulings = bench.run(periods.parking + periods.half_time_break + 0.1)
    placed = [placement for ruling in rulings for placement in ruling.placements]
    heading = next(p.heading for p in placed if p.body == "cyan1")
    assert heading == pytest.approx(bench.starts["cyan1"].team(-1).heading)


def test_after_the_change_of_sides_a_goal_counts_for_the_side_that_attacks_there(bench):
    bench.playing()
    bench.ask("end_half")
    bench.until(lambda state: state.half == 2)
    line = bench.pitch.goal_line
    ruling = bench.crossing((line - 0.1, 0.0), (line + 0.2, 0.0), ["magenta2"])
    assert ruling.state.score.magenta == 1 and "own goal" not in ruling.events[0].text


def test_a_match_ends_with_its_last_half_and_stays_so(new_bench):
    bench = new_bench(duration=4.0)
    bench.until(lambda state: state.phase is Phase.FULL_TIME, 120.0)
    assert bench.state.clock == pytest.approx(4.0) and bench.state.half == 2
    assert bench.kinds().count(EventKind.FULL_TIME) == 1
    assert bench.events[-1].time - bench.events[-2].time == pytest.approx(bench.book.periods.parking)
    ended = len(bench.events)
    bench.run(5.0)
    assert bench.state.phase is Phase.FULL_TIME and len(bench.events) == ended


def test_a_half_that_was_ended_early_leaves_the_other_its_whole_time(new_bench):
    bench = new_bench(duration=20.0)
    bench.playing()
    bench.ask("end_half")
    early = bench.state.clock
    bench.until(lambda state: state.phase is Phase.FULL_TIME, 120.0)
    assert early < 1.0 and bench.state.clock == pytest.approx(early + 10.0)


def test_a_match_that_is_not_automatic_waits_for_start(new_bench):
    bench = new_bench(automatic=False)
    bench.run(5.0)
    assert bench.state.phase is Phase.PRE_GAME and bench.events == []
    assert bench.ask("start").replies[0].accepted
    assert bench.state.phase is Phase.KICK_OFF and bench.state.side is Side.CYAN


def test_a_robot_without_a_start_pose_is_named(new_bench):
    with pytest.raises(TouchlineError, match="cyan1"):
        new_bench(starts={})
