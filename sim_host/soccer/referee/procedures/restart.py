"""The restart sequence: STOP, ball placed and restart signalled, START, ball in play.

Robots take positions after the signal. START is given after the rule book's pause, as soon as all positions are legal
and the ball is on its spot, and at the latest when the positions limit is over, which counts from the signal in the
league. A robot that is in a wrong position then is named, and moved or shown a card if the rule book says so. The ball
is in play once it has rolled freely far enough, or when the taker's time is over, after which any robot may play it; a
dropped ball is in play at once. If an obstacle stands on the spot, the restart is taken from the nearest free place: a
kick-off on the halfway line, a penalty at the same distance from the goal.

Section: restarts.
Measures: the time since STOP, signal and START; the distance of the ball from its spot, and its longest way between two
touches.
Not judged: which side wasted the time.
"""

import math
from collections.abc import Sequence

from schemas.soccer.game import Card, EventKind, GameStage, OfficiatingMode, Phase
from sim_host.soccer.referee.evidence import NO_EVIDENCE
from sim_host.soccer.referee.game import set_piece
from sim_host.soccer.referee.game.restart import Restart
from sim_host.soccer.referee.game.set_piece import PositionFault
from sim_host.soccer.referee.game.timing import reached
from sim_host.soccer.referee.offence_order import worst_first
from sim_host.soccer.referee.placement.clear_ground import clear_restart
from sim_host.soccer.referee.placement.legal_poses import legal_poses
from sim_host.soccer.referee.placement.positions import is_spot_covered, position_faults
from sim_host.soccer.referee.procedures import discipline, offences
from sim_host.soccer.referee.procedures.ending import suspend_play
from sim_host.soccer.referee.ruling_draft import RulingDraft
from sim_host.soccer.referee.situation import Situation
from sim_host.soccer.referee.wording import restart_text

RULE = "restart"
POSITIONS = "positions"


def stop(draft: RulingDraft, rule: str, restart: Restart | None) -> None:
    """Stop the game at once; without a restart, people have to decide how it goes on."""
    follows = f"{restart_text(restart)} follows" if restart is not None else "the referee decides how it goes on"
    draft.add_event(EventKind.STOP, rule, f"STOP; {follows}")
    suspend_play(draft, Phase.STOPPED, draft.book.restarts.stop_to_signal if restart is not None else None, restart)


def signal(draft: RulingDraft, restart: Restart) -> None:
    """Place the ball and signal the restart; robots take their positions.

    If a robot stands on the spot, the ball is placed as soon as the robot has left. If an obstacle does, the ball is
    placed beside it.
    """
    state, meant = draft.state, restart
    restart = clear_restart(draft.match, draft.state, draft.snapshot, meant)
    if not is_spot_covered(draft.match, state, restart.spot, draft.snapshot):
        draft.place_ball(restart.spot)
    draft.state = state._replace(
        phase=restart.phase,
        side=restart.side,
        spot=restart.spot,
        running=False,
        pending=None,
        set_piece=None,
        timing=state.timing.restart_timer(draft.book.restarts.signal_to_start),
        evidence=NO_EVIDENCE,
    )
    moved = math.dist(meant.spot, restart.spot)
    beside = f", {moved:.2f} m from its spot, where an obstacle stands" if moved > 0.0 else ""
    draft.add_event(EventKind.RESTART, RULE, restart_text(restart) + beside, side=restart.side, place=restart.spot)


def start(draft: RulingDraft, restart: Restart, remark: str = "") -> None:
    """Give START of the signalled restart; the first of a half starts the clock, and a drop ball is in play at once."""
    state = draft.state
    draft.state = state._replace(
        running=True,
        timing=state.timing.restart_timer(time_limit(draft, restart), runs=state.stage is not GameStage.SHOOT_OUT),
        set_piece=set_piece.started(restart),
        evidence=NO_EVIDENCE,
    )
    draft.checkpoint = restart.phase is Phase.KICK_OFF
    draft.add_event(
        EventKind.START, RULE, f"START of the {restart_text(restart)}{remark}", side=restart.side, place=restart.spot
    )
    if restart.phase is Phase.DROP_BALL:
        _in_play(draft, restart, "a dropped ball is in play at once")


def advance(draft: RulingDraft, restart: Restart) -> None:
    """Apply the effects of time and of the ball while a restart is signalled or taken."""
    if not draft.state.running:
        _before_start(draft, restart)
    elif draft.state.stage is not GameStage.SHOOT_OUT:
        _before_play(draft, restart)


def drop_settled_set_piece(draft: RulingDraft) -> None:
    """Drop the set piece as soon as its rules no longer restrict any robot."""
    piece = draft.state.set_piece
    if piece is None or draft.state.phase is not Phase.PLAY:
        return
    if set_piece.is_settled(piece, draft.book, draft.snapshot):
        draft.state = draft.state._replace(set_piece=None)


def time_limit(draft: RulingDraft, restart: Restart) -> float:
    """s after START until any robot may take the restart; in a shoot-out, until the attempt is over."""
    if draft.state.stage is GameStage.SHOOT_OUT:
        return draft.book.periods.shoot_out_limit
    numbers = draft.book.restarts
    return numbers.penalty_limit if restart.phase is Phase.PENALTY else numbers.time_limit


def from_spot(draft: RulingDraft, restart: Restart) -> float:
    """m on the ground between the ball and its spot."""
    ball = draft.snapshot.ball
    return math.dist(restart.spot, (ball.x, ball.y))


def _before_start(draft: RulingDraft, restart: Restart) -> None:
    """Between signal and START: keep the ball on its spot, and give START as soon as all positions are legal."""
    numbers, timer = draft.book.restarts, draft.state.timing.timer
    if clear_restart(draft.match, draft.state, draft.snapshot, restart) != restart:
        signal(draft, restart)  # again, beside an obstacle that was added meanwhile
        return
    on_spot = from_spot(draft, restart) <= numbers.drift
    has_room = on_spot or not is_spot_covered(draft.match, draft.state, restart.spot, draft.snapshot)
    if not on_spot and timer > 0 and has_room:
        draft.place_ball(restart.spot)
    if draft.match.mode is OfficiatingMode.MANUAL or not reached(timer, numbers.signal_to_start):
        return
    wrong = position_faults(draft.match, draft.state, restart, draft.snapshot)
    if on_spot and not wrong:
        start(draft, restart)
    elif reached(timer, numbers.positions_limit):
        _start_with_faults(draft, restart, wrong)
        if not has_room and numbers.moves_offenders:
            draft.place_ball(restart.spot)


def _start_with_faults(draft: RulingDraft, restart: Restart, wrong: Sequence[PositionFault]) -> None:
    """START when the positions limit is over: name robots in wrong positions, move them or show them a card."""
    numbers, wrong = draft.book.restarts, _nearest_last(draft, wrong)
    poses = legal_poses(draft.match, draft.state, restart, draft.snapshot, wrong) if numbers.moves_offenders else []
    for place, fault in enumerate(wrong):
        robot = draft.snapshot.robots[draft.match.roster.names.index(fault.robot)]
        draft.add_event(
            EventKind.FOUL,
            POSITIONS,
            f"{fault.text} after {draft.state.timing.timer:.1f} s",
            side=draft.match.roster.side_of(fault.robot),
            robot=fault.robot,
            place=(robot.x, robot.y),
            measured=fault.measured,
            limit=fault.limit,
            unit="m",
        )
        draft.state = draft.state._replace(offender=fault.robot)
        if numbers.moves_offenders:
            draft.place_robot(fault.robot, poses[place])
        is_card = bool(numbers.position_card) or offences.is_next_a_card(draft, POSITIONS, fault.robot)
        offences.count(draft, POSITIONS, fault.robot)
        if is_card and draft.match.mode is OfficiatingMode.AUTOMATIC:
            discipline.show_card(draft, POSITIONS, fault.robot, Card.YELLOW)
    start(draft, restart, f", although {wrong[0].text}" if wrong else "")


def _nearest_last(draft: RulingDraft, wrong: Sequence[PositionFault]) -> Sequence[PositionFault]:
    """The faults in an order that is the same for both sides: the robot nearest to the ball is the last offender."""
    places, robots, ball = draft.match.roster.names, draft.snapshot.robots, draft.snapshot.ball
    indices = {fault: places.index(fault.robot) for fault in wrong}

    def away(fault: PositionFault) -> float:
        robot = robots[indices[fault]]
        return (robot.x - ball.x) ** 2 + (robot.y - ball.y) ** 2

    return worst_first(Situation(draft.match, draft.state, draft.snapshot, None), wrong, away, indices.__getitem__)


def _before_play(draft: RulingDraft, restart: Restart) -> None:
    """Between START and ball in play: the ball is in play after its free roll, or when the time is over."""
    numbers, piece = draft.book.restarts, draft.state.set_piece
    limit = time_limit(draft, restart)
    rolled = piece.rolled if piece is not None and numbers.restart_fouls else from_spot(draft, restart)
    if rolled >= numbers.in_play_distance:
        _in_play(draft, restart, f"ball in play after {rolled:.2f} m, {numbers.in_play_distance:.2f} m required")
    elif reached(draft.state.timing.timer, limit):
        _in_play(draft, restart, f"ball in play {limit:g} s after START: any robot may take it")


def _in_play(draft: RulingDraft, restart: Restart, text: str) -> None:
    draft.add_event(EventKind.IN_PLAY, RULE, text, side=restart.side, robot=draft.state.last_touch)
    state = draft.state
    draft.state = state._replace(phase=Phase.PLAY, side=None, spot=None, timing=state.timing.restart_timer(None))
