"""Whole restart sequences: STOP, ball placed and signal, START, ball in play."""

import math

import pytest

from schemas.game import EventKind, Phase
from schemas.side import Side

STOP, RESTART, START, IN_PLAY = EventKind.STOP, EventKind.RESTART, EventKind.START, EventKind.IN_PLAY


def moment(bench, kind):
    return next(event.time for event in reversed(bench.events) if event.kind is kind)


def thrown_in(bench):
    """A throw-in for magenta at x = 1 is about to be signalled."""
    bench.crossing((1.0, bench.pitch.touch_line - 0.1), (1.0, bench.pitch.touch_line + 0.3), ["cyan2"])
    bench.events = bench.events[-2:]
    return bench


def test_an_automatic_match_signals_the_kick_off_at_the_first_step(bench):
    ruling = bench.tick((3.0, 3.0))
    assert ruling.events[0].kind is RESTART
    assert (ruling.state.phase, ruling.state.side, ruling.state.spot) == (Phase.KICK_OFF, Side.CYAN, (0.0, 0.0))
    assert [(p.body, p.x, p.y) for p in ruling.placements] == [("ball", 0.0, 0.0)]


def test_a_throw_in_runs_through_stop_signal_start_and_in_play_in_their_times(bench):
    thrown_in(bench)
    numbers = bench.book.restarts
    bench.until(lambda state: state.phase is Phase.THROW_IN)
    spot = (1.0, bench.pitch.touch_line - numbers.touch_line_inset)
    assert bench.state.side is Side.MAGENTA and bench.state.spot == pytest.approx(spot)
    assert bench.ball[:2] == pytest.approx(spot)
    assert moment(bench, RESTART) - moment(bench, STOP) == pytest.approx(numbers.stop_to_signal)
    bench.until(lambda state: state.running)
    assert moment(bench, START) - moment(bench, RESTART) == pytest.approx(numbers.signal_to_start)
    assert bench.state.phase is Phase.THROW_IN
    bench.tick(spot, ["magenta2"], kicked="magenta2")
    bench.tick((1.0, spot[1] - numbers.in_play_distance + 0.01))
    assert bench.state.phase is Phase.THROW_IN
    bench.tick((1.0, spot[1] - numbers.in_play_distance - 0.01))
    assert bench.state.phase is Phase.PLAY and bench.state.side is None and bench.state.spot is None
    assert bench.kinds() == [EventKind.BALL_OUT, STOP, RESTART, START, IN_PLAY]


def test_a_ball_that_nobody_plays_is_in_play_after_the_time_limit(bench):
    thrown_in(bench).until(lambda state: state.running)
    bench.until(lambda state: state.phase is Phase.PLAY)
    assert moment(bench, IN_PLAY) - moment(bench, START) == pytest.approx(bench.book.restarts.time_limit)


def test_a_dropped_ball_is_in_play_at_start(bench):
    bench.playing()
    bench.ask("drop_ball", place=(0.0, 1.0))
    bench.until(lambda state: state.running)
    assert bench.state.phase is Phase.PLAY
    assert bench.kinds()[-2:] == [START, IN_PLAY] and bench.events[-1].time == bench.events[-2].time


@pytest.mark.parametrize(("away", "put_back"), [(0.09, False), (0.11, True)])
def test_before_start_a_ball_that_drifts_is_put_back(bench, away, put_back):
    thrown_in(bench).until(lambda state: state.phase is Phase.THROW_IN)
    bench.run(0.1)
    spot = bench.state.spot
    ruling = bench.tick((spot[0] - away, spot[1]))
    assert [p.body for p in ruling.placements] == (["ball"] if put_back else [])
    if put_back:
        assert bench.ball[:2] == pytest.approx(spot)


def test_start_waits_until_the_ball_lies_on_its_spot(bench):
    thrown_in(bench).until(lambda state: state.phase is Phase.THROW_IN)
    bench.run(bench.book.restarts.signal_to_start - 0.1)
    spot = bench.state.spot
    for _ in range(20):
        bench.tick((spot[0] + 0.2, spot[1]))
    assert not bench.state.running
    bench.tick()
    assert bench.state.running


@pytest.mark.parametrize("robot", ["magenta2", "cyan2"])
def test_the_ball_is_not_put_into_a_robot_on_its_spot_and_start_waits_until_it_has_gone(bench, robot):
    thrown_in(bench)
    x, y = bench.state.pending.spot
    bench.robots[robot] = (x, y - 0.1)
    bench.until(lambda state: state.phase is Phase.THROW_IN)
    assert bench.ball[:2] != pytest.approx((x, y))
    beside = (x + bench.hull + bench.radius, y)
    for _ in range(round((bench.book.restarts.signal_to_start + 1.0) / bench.dt)):
        ruling = bench.tick(beside)
        assert not ruling.placements and not ruling.state.running
    touching = bench.hull + bench.radius
    bench.robots[robot] = (x, y - (touching if robot == "magenta2" else touching + 3.5))
    bench.tick(beside)
    assert bench.ball[:2] == pytest.approx((x, y))
    bench.tick()
    assert bench.state.running


def test_who_stands_on_the_balls_spot_at_the_limit_is_moved_and_the_ball_put_there(bench):
    thrown_in(bench).until(lambda state: state.phase is Phase.THROW_IN)
    x, y = bench.state.spot
    bench.robots["magenta2"] = (x, y - 0.1)
    while not bench.state.running:
        bench.tick((x + 0.5, y))
    assert math.dist(bench.robots["magenta2"], (x, y)) > bench.hull + bench.radius
    assert bench.ball[:2] == pytest.approx((x, y)) and "magenta2 stands on the ball's spot" in bench.events[-1].text


def test_start_waits_until_opponents_have_left_and_is_given_at_once_then(bench):
    thrown_in(bench)
    numbers = bench.book.restarts
    near = bench.pitch.touch_line - numbers.touch_line_inset - numbers.opponent_distance - bench.hull
    bench.robots["cyan4"] = (1.0, near + 0.01)
    bench.until(lambda state: state.phase is Phase.THROW_IN)
    bench.run(numbers.signal_to_start + 1.0)
    assert not bench.state.running
    bench.robots["cyan4"] = (1.0, near - 0.01)
    bench.tick()
    assert bench.state.running


def test_start_waits_no_longer_than_the_limit_and_then_says_who_stood_wrong(bench):
    thrown_in(bench)
    bench.robots["cyan4"] = (1.0, bench.pitch.touch_line - 1.0)
    bench.until(lambda state: state.running)
    numbers = bench.book.restarts
    waited = moment(bench, START) - moment(bench, RESTART)
    assert waited == pytest.approx(numbers.signal_to_start + numbers.positions_limit)
    assert "cyan4 stands" in bench.events[-1].text


def test_only_the_tick_with_start_of_a_kick_off_is_a_checkpoint(bench):
    rulings = bench.run(bench.book.restarts.signal_to_start + 1.0)
    marked = [ruling for ruling in rulings if ruling.checkpoint]
    assert len(marked) == 1 and [event.kind for event in marked[0].events] == [START]
    bench.playing()
    bench.ask("free_kick", Side.CYAN)
    assert not any(ruling.checkpoint for ruling in bench.run(20.0))


def test_a_ball_that_leaves_before_it_is_in_play_is_out(bench):
    bench.playing()
    bench.ask("throw_in", Side.CYAN, (0.0, 5.0))
    bench.until(lambda state: state.running)
    bench.tick(bench.state.spot, ["cyan2"], kicked="cyan2")
    ruling = bench.tick((0.0, bench.pitch.touch_line + bench.radius + 0.01))
    assert ruling.events[0].rule == "touch_line" and ruling.state.pending.side is Side.MAGENTA
