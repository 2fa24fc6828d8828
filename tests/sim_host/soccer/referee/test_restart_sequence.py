"""Whole restart sequences: STOP, ball placed and signal, START, ball in play."""

import math

import pytest

from schemas.side import Side
from schemas.soccer.game import EventKind, Phase

STOP, RESTART, START, IN_PLAY = EventKind.STOP, EventKind.RESTART, EventKind.START, EventKind.IN_PLAY


def moment(rig, kind):
    return next(event.time for event in reversed(rig.events) if event.kind is kind)


def thrown_in(rig):
    """A throw-in for magenta at x = 1 is about to be signalled."""
    rig.crossing((1.0, rig.pitch.touch_line - 0.1), (1.0, rig.pitch.touch_line + 0.3), ["cyan2"])
    rig.events = rig.events[-2:]
    return rig


def test_an_automatic_match_signals_the_kick_off_at_the_first_step(rig):
    ruling = rig.tick((3.0, 3.0))
    assert ruling.events[0].kind is RESTART
    assert (ruling.state.phase, ruling.state.side, ruling.state.spot) == (Phase.KICK_OFF, Side.CYAN, (0.0, 0.0))
    assert [(p.body, p.x, p.y) for p in ruling.placements] == [("ball", 0.0, 0.0)]


def test_a_throw_in_runs_through_stop_signal_start_and_in_play_in_their_times(rig):
    thrown_in(rig)
    numbers = rig.book.restarts
    rig.until(lambda state: state.phase is Phase.THROW_IN)
    spot = (1.0, rig.pitch.touch_line - numbers.touch_line_inset)
    assert rig.state.side is Side.MAGENTA and rig.state.spot == pytest.approx(spot)
    assert rig.ball[:2] == pytest.approx(spot)
    assert moment(rig, RESTART) - moment(rig, STOP) == pytest.approx(numbers.stop_to_signal)
    rig.until(lambda state: state.running)
    assert moment(rig, START) - moment(rig, RESTART) == pytest.approx(numbers.signal_to_start)
    assert rig.state.phase is Phase.THROW_IN
    rig.tick(spot, ["magenta2"], kicked="magenta2")
    rig.tick((1.0, spot[1] - numbers.in_play_distance + 0.01))
    assert rig.state.phase is Phase.THROW_IN
    rig.tick((1.0, spot[1] - numbers.in_play_distance - 0.01))
    assert rig.state.phase is Phase.PLAY and rig.state.side is None and rig.state.spot is None
    assert rig.kinds() == [EventKind.BALL_OUT, STOP, RESTART, START, IN_PLAY]


def test_a_dropped_ball_is_in_play_at_start(rig):
    rig.playing()
    rig.ask("drop_ball", place=(0.0, 1.0))
    rig.until(lambda state: state.running)
    assert rig.state.phase is Phase.PLAY
    assert rig.kinds()[-2:] == [START, IN_PLAY] and rig.events[-1].time == rig.events[-2].time


@pytest.mark.parametrize(("away", "put_back"), [(0.09, False), (0.11, True)])
def test_before_start_a_ball_that_drifts_is_put_back(rig, away, put_back):
    thrown_in(rig).until(lambda state: state.phase is Phase.THROW_IN)
    rig.run(0.1)
    spot = rig.state.spot
    ruling = rig.tick((spot[0] - away, spot[1]))
    assert [p.body for p in ruling.placements] == (["ball"] if put_back else [])
    if put_back:
        assert rig.ball[:2] == pytest.approx(spot)


def test_start_waits_until_the_ball_lies_on_its_spot(rig):
    thrown_in(rig).until(lambda state: state.phase is Phase.THROW_IN)
    rig.run(rig.book.restarts.signal_to_start - 0.1)
    spot = rig.state.spot
    for _ in range(20):
        rig.tick((spot[0] + 0.2, spot[1]))
    assert not rig.state.running
    rig.tick()
    assert rig.state.running


@pytest.mark.parametrize("robot", ["magenta2", "cyan2"])
def test_the_ball_is_not_put_into_a_robot_on_its_spot_and_start_waits_until_it_has_gone(rig, robot):
    thrown_in(rig)
    x, y = rig.state.pending.spot
    rig.robots[robot] = (x, y - 0.1)
    rig.until(lambda state: state.phase is Phase.THROW_IN)
    assert rig.ball[:2] != pytest.approx((x, y))
    beside = (x + rig.hull + rig.radius, y)
    for _ in range(round((rig.book.restarts.signal_to_start + 1.0) / rig.dt)):
        ruling = rig.tick(beside)
        assert not ruling.placements and not ruling.state.running
    touching = rig.hull + rig.radius
    rig.robots[robot] = (x, y - (touching if robot == "magenta2" else touching + 3.5))
    rig.tick(beside)
    assert rig.ball[:2] == pytest.approx((x, y))
    rig.tick()
    assert rig.state.running


def test_who_stands_on_the_balls_spot_at_the_limit_is_moved_and_the_ball_put_there(rig):
    thrown_in(rig).until(lambda state: state.phase is Phase.THROW_IN)
    x, y = rig.state.spot
    rig.robots["magenta2"] = (x, y - 0.1)
    while not rig.state.running:
        rig.tick((x + 0.5, y))
    assert math.dist(rig.robots["magenta2"], (x, y)) > rig.hull + rig.radius
    assert rig.ball[:2] == pytest.approx((x, y)) and "magenta2 stands on the ball's spot" in rig.events[-1].text


def test_start_waits_until_opponents_have_left_and_is_given_at_once_then(rig):
    thrown_in(rig)
    numbers = rig.book.restarts
    near = rig.pitch.touch_line - numbers.touch_line_inset - numbers.opponent_distance - rig.hull
    rig.robots["cyan4"] = (1.0, near + 0.01)
    rig.until(lambda state: state.phase is Phase.THROW_IN)
    rig.run(numbers.signal_to_start + 1.0)
    assert not rig.state.running
    rig.robots["cyan4"] = (1.0, near - 0.01)
    rig.tick()
    assert rig.state.running


@pytest.mark.parametrize(
    ("rules", "latest"), [("msl", 7.0), ("paper", 7.0), ("china-sim-2020", 7.0), ("friendly", 9.0)]
)
def test_start_waits_for_no_robot_beyond_the_limit_which_counts_from_the_signal(new_rig, rules, latest):
    rig = thrown_in(new_rig("msl", rules))
    rig.robots["cyan4"] = (1.0, rig.pitch.touch_line - 1.0)
    rig.until(lambda state: state.running)
    assert moment(rig, START) - moment(rig, RESTART) == pytest.approx(latest)
    assert "cyan4 stands" in rig.events[-1].text


@pytest.mark.parametrize("deed", ["free_kick", "throw_in", "corner", "goal_kick", "drop_ball", "penalty", "kick_off"])
def test_every_restart_has_the_same_latest_start(new_rig, deed):
    rig = new_rig().playing()
    rig.ask(deed, None if deed == "drop_ball" else Side.CYAN)
    rig.until(lambda state: state.spot is not None)
    signalled = moment(rig, RESTART)
    while not rig.state.running:
        x, y = rig.state.spot
        rig.robots["magenta4"] = (x * 0.9, y - 0.5)
        rig.tick()
    assert moment(rig, START) - signalled == pytest.approx(7.0)


def test_only_the_tick_with_start_of_a_kick_off_is_a_checkpoint(rig):
    rulings = rig.run(rig.book.restarts.signal_to_start + 1.0)
    marked = [ruling for ruling in rulings if ruling.checkpoint]
    assert len(marked) == 1 and [event.kind for event in marked[0].events] == [START]
    rig.playing()
    rig.ask("free_kick", Side.CYAN)
    assert not any(ruling.checkpoint for ruling in rig.run(20.0))


def test_a_ball_that_leaves_before_it_is_in_play_is_out(rig):
    rig.playing()
    rig.ask("throw_in", Side.CYAN, (0.0, 5.0))
    rig.until(lambda state: state.running)
    rig.tick(rig.state.spot, ["cyan2"], kicked="cyan2")
    ruling = rig.tick((0.0, rig.pitch.touch_line + rig.radius + 0.01))
    assert ruling.events[0].rule == "touch_line" and ruling.state.pending.side is Side.MAGENTA
