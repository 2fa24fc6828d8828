"""Robots that leave their places at a penalty before the kick, between START and the outcome.

The kicker is the robot of its side that is nearest to the ball at START; no teammate takes its place.
In play, all robots but the kicker have their places until the kick. In a shoot-out, in which the kicker may dribble,
the goalkeeper has its place until the kicker's side touches the ball, and the others until the end of the attempt.
"""

from schemas.soccer.game import GameStage, Phase
from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.match_constants import MatchConstants
from sim_host.soccer.referee.placement.positions import kicker_of, penalty_faults


def with_strays(match: MatchConstants, state: RefereeState, snapshot: Snapshot) -> RefereeState:
    """The state after START, with the robots that have strayed by this tick."""
    piece = state.set_piece
    if piece is None or state.phase is not Phase.PENALTY or match.book.fouls.penalty_kick == "off":
        return state
    in_shoot_out = state.stage is GameStage.SHOOT_OUT
    if not in_shoot_out and (piece.kicker is not None or piece.moved > match.book.restarts.drag_distance):
        return state
    if piece.appointed is None:
        piece = piece._replace(appointed=kicker_of(match, state, piece.restart, snapshot))
    known = {stray.robot for stray in piece.strays}
    free = _free_keepers(match, state) if in_shoot_out else ()
    new = [
        fault
        for fault in penalty_faults(match, state, piece, snapshot)
        if fault.robot not in known and fault.robot not in free
    ]
    if new:
        piece = piece._replace(strays=(*piece.strays, *new))
    return state if piece is state.set_piece else state._replace(set_piece=piece)


def _free_keepers(match: MatchConstants, state: RefereeState) -> tuple[str, ...]:
    """Goalkeepers that may leave their places, as the kicker's side has touched the ball."""
    piece, roster = state.set_piece, match.roster
    if piece is None or not any(roster.side_of(name) is piece.restart.side for name in piece.touched):
        return ()
    keepers = match.keepers(state.participation.absences)
    return tuple([name for name, keeps in zip(roster.names, keepers, strict=True) if keeps])
