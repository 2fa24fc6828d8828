"""Halves: the clock, the end of a half, change of sides, full time."""

import pytest

from schemas.config.soccer.rule_book import load_rule_book
from schemas.errors import TouchlineError
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase


def test_the_clock_runs_from_the_first_start_also_through_stoppages(new_rig):
    rig = new_rig(duration=200.0)
    rig.until(lambda state: state.running)
    assert rig.state.clock == 0.0
    rig.playing()
    rig.ask("stop")
    before = rig.state.clock
    rig.run(3.0)
    assert rig.state.phase is Phase.STOPPED and rig.state.clock - before == pytest.approx(3.0)


@pytest.mark.parametrize("halted", [False, True])
def test_a_half_ends_at_once_when_its_time_is_up(new_rig, halted):
    rig = new_rig(duration=10.0)
    rig.playing()
    if halted:
        rig.ask("stop")
    rig.until(lambda state: state.phase is Phase.PARKING)
    assert rig.state.clock == pytest.approx(5.0)
    assert (rig.events[-1].kind, rig.events[-1].rule) == (EventKind.HALF_TIME, "half_end")


def test_without_a_duration_a_half_lasts_as_long_as_in_the_rule_book(new_rig):
    rig = new_rig(rules="friendly")
    assert rig.state.timing.limit == load_rule_book("friendly").periods.half_duration


def test_after_the_break_sides_are_changed_and_the_other_side_kicks_off(rig):
    rig.playing()
    rig.ask("end_half")
    ended = rig.events[-1].time
    clock = rig.state.clock
    rig.robots["cyan2"] = (3.0, 3.0)
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    state = rig.state
    pause = rig.book.periods.parking + rig.book.periods.half_time_break
    assert rig.events[-1].time - ended == pytest.approx(pause)
    assert (state.half, state.cyan_attacks, state.side, state.clock) == (2, -1, Side.MAGENTA, clock)
    for name, pose in rig.starts.items():
        assert rig.robots[name] == pytest.approx((-pose.x, -pose.y))
    rig.until(lambda state: state.running)
    assert rig.events[-1].time - ended < pause + rig.book.restarts.signal_to_start + 1


def test_carried_robots_face_the_direction_they_attack(rig):
    rig.playing()
    rig.ask("end_half")
    periods = rig.book.periods
    rulings = rig.run(periods.parking + periods.half_time_break + 0.1)
    placed = [placement for ruling in rulings for placement in ruling.placements]
    heading = next(p.heading for p in placed if p.body == "cyan1")
    assert heading == pytest.approx(rig.starts["cyan1"].team(-1).heading)


def test_after_the_change_of_sides_a_goal_counts_for_the_side_that_attacks_there(rig):
    rig.playing()
    rig.ask("end_half")
    rig.until(lambda state: state.half == 2)
    line = rig.pitch.goal_line
    ruling = rig.crossing((line - 0.1, 0.0), (line + 0.2, 0.0), ["magenta2"])
    assert ruling.state.score.magenta == 1 and "own goal" not in ruling.events[0].text


def test_a_match_ends_with_its_last_half_and_stays_so(new_rig):
    rig = new_rig(duration=4.0)
    rig.until(lambda state: state.phase is Phase.FULL_TIME, 120.0)
    assert rig.state.clock == pytest.approx(4.0) and rig.state.half == 2
    assert rig.kinds().count(EventKind.FULL_TIME) == 1
    assert rig.events[-1].time - rig.events[-2].time == pytest.approx(rig.book.periods.parking)
    ended = len(rig.events)
    rig.run(5.0)
    assert rig.state.phase is Phase.FULL_TIME and len(rig.events) == ended


def test_a_half_that_was_ended_early_leaves_the_other_its_whole_time(new_rig):
    rig = new_rig(duration=20.0)
    rig.playing()
    rig.ask("end_half")
    early = rig.state.clock
    rig.until(lambda state: state.phase is Phase.FULL_TIME, 120.0)
    assert early < 1.0 and rig.state.clock == pytest.approx(early + 10.0)


def test_a_robot_without_a_start_pose_is_named(new_rig):
    with pytest.raises(TouchlineError, match="cyan1"):
        new_rig(starts={})
