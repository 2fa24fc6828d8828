"""The restart sequence: STOP, ball placed and restart signalled, START, ball in play.

Robots take positions from the signal on. START comes after the rule book's pause, as soon as everybody stands legally
and the ball lies on its spot, at the latest after the positions limit: who stands wrong then is named, and moved or
shown a card as the rule book says. The ball is in play once it has rolled freely far enough, or when the taker's time
is over, from when on anybody may take it; a dropped ball at once. Where an obstacle stands on the spot, the restart is
taken from the nearest free place, a kick-off on the halfway line, a penalty as far from the goal.

Section: restarts.
Measures: the time since STOP, signal and START; the ball's way from its spot, and its longest way between two touches.
Not judged: who let the time go by.
"""

import math

from schemas.game import Card, EventKind, Mode, Phase, Stage
from sim_host.referee import discipline, set_piece
from sim_host.referee.call import Restart
from sim_host.referee.clear_ground import clear_restart
from sim_host.referee.evidence import NOTHING
from sim_host.referee.positions import Fault, covered, legal_spot, standing_wrong
from sim_host.referee.timing import reached
from sim_host.referee.turn import Turn
from sim_host.referee.wording import named

RULE = "restart"
POSITIONS = "positions"


def stop(turn: Turn, rule: str, restart: Restart | None) -> None:
    """Halt the game at once; without a restart, people have to decide how it goes on."""
    follows = f"{named(restart)} follows" if restart is not None else "the referee decides how it goes on"
    turn.say(EventKind.STOP, rule, f"STOP; {follows}")
    state = turn.state
    turn.state = state._replace(
        phase=Phase.STOPPED,
        side=None,
        spot=None,
        running=False,
        pending=restart,
        set_piece=None,
        proposal=None,
        people=discipline.new_stoppage(state.people),
        timing=state.timing.anew(turn.book.restarts.stop_to_signal if restart is not None else None),
    )


def signal(turn: Turn, restart: Restart) -> None:
    """Place the ball and signal the restart; robots take their positions.

    Where a robot stands on the spot, the ball is placed as soon as it has gone; where an obstacle does, which nobody
    moves, beside it.
    """
    state, meant = turn.state, restart
    restart = clear_restart(turn.match, turn.snapshot, meant)
    if not covered(turn.match, state, restart.spot, turn.snapshot):
        turn.place_ball(restart.spot)
    turn.state = state._replace(
        phase=restart.phase,
        side=restart.side,
        spot=restart.spot,
        running=False,
        pending=None,
        set_piece=None,
        timing=state.timing.anew(turn.book.restarts.signal_to_start),
        evidence=NOTHING,
    )
    moved = math.dist(meant.spot, restart.spot)
    beside = f", {moved:.2f} m from its spot, where an obstacle stands" if moved > 0.0 else ""
    turn.say(EventKind.RESTART, RULE, named(restart) + beside, side=restart.side, place=restart.spot)


def start(turn: Turn, restart: Restart, remark: str = "") -> None:
    """Give START of the signalled restart; the first of a half sets the clock going, a drop ball is in play at once."""
    state = turn.state
    turn.state = state._replace(
        running=True,
        timing=state.timing.anew(time_limit(turn, restart), runs=state.stage is not Stage.SHOOT_OUT),
        set_piece=set_piece.begun(restart),
        evidence=NOTHING,
    )
    turn.checkpoint = restart.phase is Phase.KICK_OFF
    turn.say(EventKind.START, RULE, f"START of the {named(restart)}{remark}", side=restart.side, place=restart.spot)
    if restart.phase is Phase.DROP_BALL:
        _in_play(turn, restart, "a dropped ball is in play at once")


def move_on(turn: Turn, restart: Restart) -> None:
    """What time and the ball bring about while a restart is signalled or taken."""
    if not turn.state.running:
        _awaited(turn, restart)
    elif turn.state.stage is not Stage.SHOOT_OUT:
        _taken(turn, restart)


def release(turn: Turn) -> None:
    """Forget the set piece as soon as nothing of it binds anybody any more."""
    piece = turn.state.set_piece
    if piece is None or turn.state.phase is not Phase.PLAY:
        return
    if set_piece.settled(piece, turn.book, turn.snapshot):
        turn.state = turn.state._replace(set_piece=None)


def time_limit(turn: Turn, restart: Restart) -> float:
    """s after START until anybody may take the restart; in a shoot-out, until the attempt is over."""
    if turn.state.stage is Stage.SHOOT_OUT:
        return turn.book.periods.shoot_out_limit
    numbers = turn.book.restarts
    return numbers.penalty_limit if restart.phase is Phase.PENALTY else numbers.time_limit


def from_spot(turn: Turn, restart: Restart) -> float:
    """m on the ground between the ball and its spot."""
    ball = turn.snapshot.ball
    return math.dist(restart.spot, (ball.x, ball.y))


def _awaited(turn: Turn, restart: Restart) -> None:
    """Between signal and START: the ball is kept on its spot, then START as soon as everybody stands legally."""
    numbers, timer = turn.book.restarts, turn.state.timing.timer
    if clear_restart(turn.match, turn.snapshot, restart) != restart:
        signal(turn, restart)  # anew, beside the obstacle that somebody has put there meanwhile
        return
    on_spot = from_spot(turn, restart) <= numbers.drift
    has_room = on_spot or not covered(turn.match, turn.state, restart.spot, turn.snapshot)
    if not on_spot and timer > 0 and has_room:
        turn.place_ball(restart.spot)
    if turn.match.mode is Mode.MANUAL or not reached(timer, numbers.signal_to_start):
        return
    wrong = standing_wrong(turn.match, turn.state, restart, turn.snapshot)
    if on_spot and not wrong:
        start(turn, restart)
    elif reached(timer, numbers.signal_to_start + numbers.positions_limit):
        _start_all_the_same(turn, restart, wrong)
        if not has_room and numbers.moves_offenders:
            turn.place_ball(restart.spot)


def _start_all_the_same(turn: Turn, restart: Restart, wrong: tuple[Fault, ...]) -> None:
    """The positions limit is over: who stands wrong is named, moved and shown a card as the rule book says."""
    numbers = turn.book.restarts
    for fault in wrong:
        robot = turn.snapshot.robots[turn.match.roster.names.index(fault.robot)]
        turn.say(
            EventKind.FOUL,
            POSITIONS,
            f"{fault.text} after {turn.state.timing.timer:.1f} s",
            side=turn.match.roster.side_of(fault.robot),
            robot=fault.robot,
            place=(robot.x, robot.y),
            measured=fault.measured,
            limit=fault.limit,
            unit="m",
        )
        if numbers.moves_offenders:
            turn.place_robot(fault.robot, legal_spot(turn.match, turn.state, restart, turn.snapshot, fault))
        if numbers.position_card and turn.match.mode is Mode.AUTOMATIC:
            discipline.show(turn, POSITIONS, fault.robot, Card.YELLOW)
    start(turn, restart, f", although {wrong[0].text}" if wrong else "")


def _taken(turn: Turn, restart: Restart) -> None:
    """Between START and ball in play."""
    numbers, piece = turn.book.restarts, turn.state.set_piece
    limit = time_limit(turn, restart)
    rolled = piece.rolled if piece is not None and numbers.restart_fouls else from_spot(turn, restart)
    if rolled >= numbers.in_play_distance:
        _in_play(turn, restart, f"ball in play after {rolled:.2f} m, {numbers.in_play_distance:.2f} m asked")
    elif reached(turn.state.timing.timer, limit):
        _in_play(turn, restart, f"ball in play {limit:g} s after START: anybody may take it")


def _in_play(turn: Turn, restart: Restart, text: str) -> None:
    turn.say(EventKind.IN_PLAY, RULE, text, side=restart.side, robot=turn.state.last_touch)
    state = turn.state
    turn.state = state._replace(phase=Phase.PLAY, side=None, spot=None, timing=state.timing.anew(None))
