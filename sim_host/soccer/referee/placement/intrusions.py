"""Intrusions: robots that come too near to a restart between START and the ball in play.

A robot that is too near when the referee looks for the first time, at START, or that an opponent pushes there, is
excused as long as it retreats.
"""

from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.restart import Restart, Spot
from sim_host.soccer.referee.game.set_piece import Intrusion, SetPiece
from sim_host.soccer.referee.match_constants import MatchConstants
from sim_host.soccer.referee.placement.positions import distance_violations

SHOVED = 0.5
"""s for which an opponent's impact explains that a robot comes nearer."""


def intrusions_after(
    match: MatchConstants, state: RefereeState, piece: SetPiece, snapshot: Snapshot, dt: float
) -> SetPiece:
    """The set piece with the intrusions after one more tick of `dt` in s."""
    found = distance_violations(match, state, piece.restart, snapshot)
    if not found and piece.intrusions == ():
        return piece
    first_look, known = piece.intrusions is None, {one.robot: one for one in piece.intrusions or ()}
    now = []
    for robot, violation in found.items():
        depth, pushed = violation.depth, _is_pushed(match, state, piece.restart, snapshot, robot)
        old = known.get(robot)
        if old is None:
            now.append(Intrusion(robot, depth, depth, excused=first_look or pushed))
        elif pushed:
            now.append(old._replace(depth=depth, least=depth))
        else:
            now.append(old._replace(depth=depth, least=min(old.least, depth), lasted=old.lasted + dt))
    return piece._replace(intrusions=tuple(now))


def _is_pushed(match: MatchConstants, state: RefereeState, restart: Restart, snapshot: Snapshot, robot: int) -> bool:
    """Whether an opponent pushes a robot toward the spot, or has just hit it."""
    sides, (x, y) = match.roster.sides, restart.spot
    for pair in snapshot.contacts:
        if robot in pair:
            other = pair[0] if pair[1] == robot else pair[1]
            behind = _squared(snapshot, other, (x, y)) > _squared(snapshot, robot, (x, y))
            if behind and sides[other] is not sides[robot]:
                return True
    return any(
        shove.robot == robot and shove.age <= SHOVED and sides[shove.by] is not sides[robot]
        for shove in state.evidence.shoves
    )


def _squared(snapshot: Snapshot, robot: int, spot: Spot) -> float:
    dx, dy = snapshot.robots[robot].x - spot[0], snapshot.robots[robot].y - spot[1]
    return dx * dx + dy * dy
