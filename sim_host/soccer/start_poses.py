"""The start poses of the robots, in the field frame with cyan attacking +x."""

import math
from collections.abc import Iterator, Sequence

from schemas.config.sections import Pitch
from schemas.config.soccer.rule_book import Restarts
from schemas.frames import Point, Pose
from schemas.side import Side
from sim_host.snapshot import Roster

_FORMATION: Sequence[Point] = (
    (-10.5, 0.0),
    (-2.0, 1.0),
    (-2.0, -1.0),
    (-5.0, 2.0),
    (-5.0, -2.0),
    (-2.0, 4.8),
    (-2.0, -4.8),
    (-5.0, 5.0),
    (-5.0, -5.0),
    (-7.5, 1.2),
    (-7.5, -1.2),
)
"""m on 22 × 14 m, the goalkeeper first; the first five are the start poses of nubot-nu's simatch."""
_MARGIN = 0.05
"""m beyond the distance that the rules demand at a kick-off, since rounding may bring a robot nearer to the ball."""
_AIR = 0.1
"""m between the hulls of two robots."""
_STEP = 0.25
"""m between the places that are tried where a robot of the formation has no room."""


def start_poses(roster: Roster, pitch: Pitch, restarts: Restarts) -> tuple[dict[str, Pose], list[str]]:
    """One pose for each robot, in its own half and facing the goal it attacks; and the robots without a legal place.

    All robots keep the distance from the centre mark that the rules demand of the side that does not kick off, since
    either side may. They stand in a formation, scaled to the pitch; a robot that has no room there has the nearest
    legal place, outside the penalty area if possible, and one that has none the nearest place without another robot.
    Magenta's places are found as cyan's, and turned by π.
    """
    poses, misplaced = dict[str, Pose](), list[str]()
    for side in Side:
        half = _Half(pitch, max(restarts.opponent_distance, restarts.teammate_distance) + _MARGIN)
        mine = [place for place, its_side in enumerate(roster.sides) if its_side is side]
        for number, place in enumerate(mine):
            name, reach = roster.names[place], roster.models[place].body.reach
            (x, y), is_legal = half.place(number, reach)
            half.taken.append((x, y, reach))
            poses[name] = Pose(x, y).team(side.attack(1))
            if not is_legal:
                misplaced.append(name)
    return poses, misplaced


class _Half:
    """The places of one side in its half, in its team frame."""

    def __init__(self, pitch: Pitch, distance: float) -> None:
        """`distance` is from a hull to the centre mark, m."""
        self._pitch = pitch
        self._distance = distance
        self.taken: list[tuple[float, float, float]] = []
        """x, y and reach of the robots that have a place, m."""

    def place(self, number: int, reach: float) -> tuple[Point, bool]:
        """The place of the robot with this index in its team's list, and whether it is legal."""
        wanted = self._wanted(number, reach)
        if self._is_legal(wanted, reach) and self._is_free(wanted, reach, 0.0):
            return wanted, True
        free = [spot for spot in self._grid(reach) if self._is_free(spot, reach, _AIR)]
        legal = [spot for spot in free if self._is_legal(spot, reach)]
        best = min(
            legal or free, key=lambda spot: (self._in_penalty_area(spot), math.dist(spot, wanted)), default=wanted
        )
        return best, bool(legal)

    def _wanted(self, number: int, reach: float) -> Point:
        """The place in the formation, moved away from the centre mark, but not beyond the goal line."""
        x, y = _FORMATION[number % len(_FORMATION)]
        x, y = x * self._pitch.length / 22.0, y * self._pitch.width / 14.0
        goal_line = self._pitch.goal_line - reach
        out = max(1.0, min((self._distance + reach) / math.hypot(x, y), goal_line / abs(x)))
        return x * out, y * out

    def _is_legal(self, spot: Point, reach: float) -> bool:
        """Whether a robot may stand there at a kick-off of either side."""
        x, y = spot
        return (
            -self._pitch.goal_line <= x - reach
            and x + reach <= 0.0
            and abs(y) + reach <= self._pitch.touch_line
            and math.hypot(x, y) - reach > self._distance - _MARGIN
        )

    def _is_free(self, spot: Point, reach: float, air: float) -> bool:
        """Whether there are `air` m or more between the robot and each other one."""
        return all(math.dist(spot, (x, y)) >= reach + other + air for x, y, other in self.taken)

    def _in_penalty_area(self, spot: Point) -> bool:
        pitch = self._pitch
        return spot[0] < pitch.penalty_area_depth - pitch.goal_line and abs(spot[1]) < pitch.penalty_area_width / 2

    def _grid(self, reach: float) -> Iterator[Point]:
        """Places of the half outside the goal area, without regard to other robots."""
        pitch = self._pitch
        rows = int((pitch.touch_line - reach) / _STEP)
        columns = int((pitch.goal_line - 2.0 * reach) / _STEP)
        for column in range(columns + 1):
            for row in range(-rows, rows + 1):
                x, y = -reach - column * _STEP, row * _STEP
                if x >= pitch.goal_area_depth - pitch.goal_line or abs(y) >= pitch.goal_area_width / 2:
                    yield x, y
