"""Intrusions: robots that come too near to a restart between START and the ball in play.

A robot that is too near when the referee looks for the first time, at START, or that an opponent pushes there, is
excused as long as it retreats.
"""

from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.evidence.shoves import is_pushed
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.set_piece import Intrusion, SetPiece
from sim_host.soccer.referee.match_constants import MatchConstants
from sim_host.soccer.referee.placement.positions import distance_violations


def intrusions_after(
    match: MatchConstants, state: RefereeState, piece: SetPiece, snapshot: Snapshot, dt: float
) -> SetPiece:
    """The set piece with the intrusions after one more tick of `dt` in s."""
    found = distance_violations(match, state, piece.restart, snapshot)
    if not found and piece.intrusions == ():
        return piece
    spot = complex(*piece.restart.spot)
    first_look, known = piece.intrusions is None, {one.robot: one for one in piece.intrusions or ()}
    now = []
    for robot, violation in found.items():
        depth, pushed = violation.depth, is_pushed(match, state.evidence.shoves, snapshot, robot, spot)
        old = known.get(robot)
        if old is None:
            now.append(Intrusion(robot, depth, depth, excused=first_look or pushed))
        elif pushed:
            now.append(old._replace(depth=depth, least=depth))
        else:
            now.append(old._replace(depth=depth, least=min(old.least, depth), lasted=old.lasted + dt))
    return piece._replace(intrusions=tuple(now))
