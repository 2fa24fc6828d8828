"""The restart sequence: STOP, ball placed and restart signalled, START, ball in play."""

import dataclasses
import math

from schemas.game import EventKind, Phase
from sim_host.referee.evidence import NOTHING
from sim_host.referee.positions import standing_wrong
from sim_host.referee.state import Restart
from sim_host.referee.turn import Turn
from sim_host.referee.wording import named

RULE = "restart"
ROUNDING = 1e-9
"""s; sums of ticks may fall this short of a limit that is a whole number of ticks."""


def stop(turn: Turn, rule: str, restart: Restart | None) -> None:
    """Halt the game at once; without a restart, people have to decide how it goes on."""
    follows = f"{named(restart)} follows" if restart is not None else "the referee decides how it goes on"
    turn.say(EventKind.STOP, rule, f"STOP; {follows}")
    turn.state = dataclasses.replace(
        turn.state, phase=Phase.STOPPED, side=None, spot=None, running=False, pending=restart, timer=0.0
    )


def signal(turn: Turn, restart: Restart) -> None:
    """Place the ball and signal the restart; robots take their positions."""
    turn.place_ball(restart.spot)
    turn.state = dataclasses.replace(
        turn.state,
        phase=restart.phase,
        side=restart.side,
        spot=restart.spot,
        running=False,
        pending=None,
        timer=0.0,
        evidence=NOTHING,
    )
    turn.say(EventKind.RESTART, RULE, named(restart), side=restart.side, place=restart.spot)


def start(turn: Turn, restart: Restart, remark: str = "") -> None:
    """Give START of the signalled restart; the first of a half sets the clock going, a drop ball is in play at once."""
    turn.state = dataclasses.replace(turn.state, running=True, clock_runs=True, timer=0.0, evidence=NOTHING)
    turn.checkpoint = restart.phase is Phase.KICK_OFF
    turn.say(EventKind.START, RULE, f"START of the {named(restart)}{remark}", side=restart.side, place=restart.spot)
    if restart.phase is Phase.DROP_BALL:
        _in_play(turn, restart, "a dropped ball is in play at once")


def move_on(turn: Turn, restart: Restart) -> None:
    """What time and the ball bring about while a restart is signalled or taken."""
    if turn.state.running:
        _taken(turn, restart)
    else:
        _awaited(turn, restart)


def from_spot(turn: Turn, restart: Restart) -> float:
    """m on the ground between the ball and its spot."""
    ball = turn.snapshot.ball
    return math.dist(restart.spot, (ball.x, ball.y))


def reached(timer: float, limit: float) -> bool:
    """Whether a timer has come to its limit, both in s."""
    return timer >= limit - ROUNDING


def _awaited(turn: Turn, restart: Restart) -> None:
    """Between signal and START: the ball is kept on its spot, then START as soon as everybody stands legally."""
    numbers, timer = turn.match.book.restarts, turn.state.timer
    on_spot = from_spot(turn, restart) <= numbers.drift
    if not on_spot and timer > 0:
        turn.place_ball(restart.spot)
    if not reached(timer, numbers.signal_to_start):
        return
    wrong = standing_wrong(turn.match, turn.state, restart, turn.snapshot)
    if on_spot and wrong is None:
        start(turn, restart)
    elif reached(timer, numbers.signal_to_start + numbers.positions_limit):
        start(turn, restart, f", although {wrong}" if wrong is not None else "")


def _taken(turn: Turn, restart: Restart) -> None:
    """Between START and ball in play."""
    numbers = turn.match.book.restarts
    moved = from_spot(turn, restart)
    if moved >= numbers.in_play_distance:
        _in_play(turn, restart, f"ball in play, {moved:.2f} m from its spot")
    elif reached(turn.state.timer, numbers.time_limit):
        _in_play(turn, restart, f"ball in play, {turn.state.timer:.1f} s after START")


def _in_play(turn: Turn, restart: Restart, text: str) -> None:
    turn.say(EventKind.IN_PLAY, RULE, text, side=restart.side, robot=turn.state.last_touch)
    turn.state = dataclasses.replace(turn.state, phase=Phase.PLAY, side=None, spot=None)
