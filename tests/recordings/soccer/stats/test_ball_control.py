"""Ball in play, possession and time with the ball, on a match made by hand in ticks of 0.1 s."""

import pytest
from pytest import approx

from schemas.side import Side
from schemas.soccer.game import Phase


def test_the_ball_is_in_play_while_the_game_state_is_running(script) -> None:
    script.rest(10)
    script.shot(phase=Phase.STOPPED, running=False)
    script.rest(20)
    script.shot(phase=Phase.THROW_IN, running=True)
    script.rest(4)
    script.shot(phase=Phase.PLAY, running=True)
    script.rest(5)
    figures = script.figures()
    assert figures.in_play_s == approx(1.1 + 0.5)
    assert figures.in_play == approx(1.6 / 4.2)


def test_a_side_is_in_control_from_its_hold_to_the_others(script) -> None:
    script.rest(5)
    script.held_by = "cyan2"
    for _ in range(4):
        script.shot(touches=["cyan2"])
    script.held_by = None
    script.rest(6)  # rolls freely: still cyan's
    script.shot(touches=["magenta2"])  # bounces off an opponent: still cyan's
    script.rest(2)
    script.held_by = "magenta2"
    script.shot(touches=["magenta2"])
    script.rest(9)
    figures = script.figures()
    cyan, magenta = (figures.sides[side] for side in Side)
    assert figures.free_s == approx(0.6)
    assert cyan.possession_s == approx(0.3 + 0.1 + 0.6 + 0.3)
    assert magenta.possession_s == approx(0.9)
    assert cyan.possession == approx(1.3 / 2.2)
    assert [robot.with_ball_s for robot in figures.robots] == approx([0.0, 0.4, 0.0, 0.9])


def test_whoever_touches_a_free_ball_is_in_control_and_a_kick_takes_it(script) -> None:
    script.shot(touches=["magenta2"])
    script.rest(4)
    script.shot(touches=["cyan2"], kicked="cyan2", speed=(3.0, 4.0, 0.0))
    script.rest(2)
    figures = script.figures()
    assert figures.sides[Side.MAGENTA].possession_s == approx(0.5)
    assert figures.sides[Side.CYAN].possession_s == approx(0.2)


def test_a_stop_ends_control(script) -> None:
    script.shot(touches=["cyan2"])
    script.out()
    script.shot(phase=Phase.PLAY, running=True)
    script.rest(5)
    figures = script.figures()
    assert figures.sides[Side.CYAN].possession_s == approx(0.1)
    assert figures.free_s == approx(0.1 + 0.5)


def test_a_recording_without_states_does_not_know_possession(script) -> None:
    script.shot(touches=["cyan2"])
    script.messages = [(time, message) for time, message in script.messages if not hasattr(message, "phase")]
    figures = script.figures()
    assert (figures.in_play_s, figures.in_play, figures.free_s) == (None, None, None)
    assert figures.sides[Side.CYAN].possession_s is None
    assert figures.sides[Side.CYAN].kicks is None
    assert figures.sides[Side.CYAN].goals is None


@pytest.mark.parametrize("touches", [[], ["cyan2"]])
def test_a_recording_without_touches_knows_possession_and_no_passes(script, touches) -> None:
    script.held_by = "cyan2"
    script.shot(touches=touches)
    script.rest(2)
    side = script.figures().sides[Side.CYAN]
    assert side.possession_s == approx(0.2)
    assert (side.kicks is not None) == bool(touches)
    assert (side.saves is not None) == bool(touches)


def test_after_ticks_that_are_missing_nobody_is_in_control_until_the_ball_is_touched(script) -> None:
    script.held_by = "cyan2"
    script.shot(touches=["cyan2"])
    script.held_by = None
    script.rest(4)  # cyan's
    script.tick += 50
    script.rest(6)  # nobody's: anything may have happened meanwhile
    figures = script.figures()
    assert figures.sides[Side.CYAN].possession_s == approx(0.4)
