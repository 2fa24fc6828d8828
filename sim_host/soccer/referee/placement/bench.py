"""The benches: places of robots that are off the field, and places where they come back.

Each side has its bench along the right touch line of its own half, where simatch parks its robots. The bench is beyond
the boundary, out of reach of the game; where the pitch is too short for all robots, it has more than one row. Robots
come back just inside that touch line, near the halfway line, where there is room.
"""

import math
from itertools import product

from schemas.frames import Pose
from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.match_constants import MatchConstants

_BEYOND = 0.5
"""m between the border and the hull of a robot on the bench; more than the thickness of the boundary."""
_SPACING = 0.2
"""m of air between two robots."""
_FIRST = 0.5
"""m between the halfway line and the hull of the first robot."""
_PLACES = 12
"""Number of places to come back that are tried in each row, if they fit along half a touch line."""


def bench_pose(match: MatchConstants, state: RefereeState, name: str) -> Pose:
    """The pose of a robot while it is off the field."""
    roster, pitch, reach = match.roster, match.pitch, max(match.reaches)
    side = roster.side_of(name)
    mates = [mate for mate in roster.names if roster.side_of(mate) is side]
    row, place = divmod(mates.index(name), _places(pitch.goal_line + pitch.border, reach))
    x = _along(place, reach)
    y = -(pitch.touch_line + pitch.border + _BEYOND + reach + row * (2.0 * reach + _SPACING))
    return Pose(x, y, math.pi / 2).team(state.attack(side))


def entry_pose(match: MatchConstants, state: RefereeState, snapshot: Snapshot, name: str) -> Pose | None:
    """The first free pose at which a robot can come back, as far from the ball as a restart requires; None if none.

    `snapshot` has all robots; those on the bench are never in the way.
    """
    roster, pitch = match.roster, match.pitch
    own, side = roster.names.index(name), roster.side_of(name)
    reach = match.reaches[own]
    ball = state.spot or (snapshot.ball.x, snapshot.ball.y)
    rows, places = range(match.book.people.entry_rows), range(min(_PLACES, _places(pitch.goal_line, reach)))
    for row, place in product(rows, places):
        x, y = _along(place, reach), -(pitch.touch_line - reach - _SPACING - row * (2.0 * reach + _SPACING))
        pose = Pose(x, y, math.pi / 2).team(state.attack(side))
        away = math.dist(ball, (pose.x, pose.y)) - reach
        if away >= match.book.restarts.opponent_distance and _is_free(match, snapshot, own, pose):
            return pose
    return None


def _places(length: float, reach: float) -> int:
    """Number of places in a row of this length in m, from the halfway line."""
    return max(1, int((length - _FIRST + _SPACING) / (2.0 * reach + _SPACING)))


def _along(place: int, reach: float) -> float:
    """x of a place, counted from 0 at the halfway line, m in the team frame."""
    return -(_FIRST + reach + place * (2.0 * reach + _SPACING))


def _is_free(match: MatchConstants, snapshot: Snapshot, own: int, pose: Pose) -> bool:
    for index, robot in enumerate(snapshot.robots):
        apart = match.reaches[own] + match.reaches[index] + _SPACING
        if index != own and math.dist((robot.x, robot.y), (pose.x, pose.y)) < apart:
            return False
    return True
