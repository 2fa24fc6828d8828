"""Finds robots that may meet another body within the next tick, once a tick.

Those that hit it are for `continuous_collision`. Those that may touch anything at all are for drives that are as strong
as their grip only.
"""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from schemas.config.profile import Profile
from schemas.config.robot_model import RobotModel
from sim_host.physics.pitch import Furniture, fixed_boxes
from sim_host.snapshot import BallState, ObstacleState, RobotState

MIN_IMPACT = 0.5
"""m/s; robots that meet more slowly lean on each other, rather than hit each other."""

_MARGIN = 0.02
"""m; bodies this much farther apart may still touch: the engine's contacts begin at such a gap."""

_NOWHERE = BallState(math.inf, math.inf, 0.0, 0.0, 0.0, 0.0)
"""A ball that no robot can touch stands for none."""

IndexPairs = list[tuple[int, int]]
_Moving = tuple[float, float, float, float, float, float, int]
"""x, y, vx, vy of a robot; the speed it may gain in the tick, m/s; how far it may reach, m; its index in the roster."""


class Candidates(NamedTuple):
    """Robots that may meet another body within the tick, by their indices in the roster."""

    hits: IndexPairs
    """Pairs of robots that may hit each other."""
    fixed: IndexPairs
    """Pairs of a robot and a body that it may hit: first the boxes of the pitch, then the obstacles."""
    touching: list[int]
    """Robots that may touch a robot, a fixed body or the ball, at any speed, sorted; of those whose drive yields."""
    meeting: bool
    """Whether one of these may touch another robot."""


class CollisionCandidates:
    """Finds robots that may meet another body; the cost grows with their number."""

    def __init__(
        self, profile: Profile, models: Sequence[RobotModel], yields: Sequence[bool], furniture: Furniture
    ) -> None:
        self._tick = tick = profile.time.tick
        self._ball_radius, pitch = profile.ball.radius, profile.field
        self._yields = yields
        """Per robot: its drive is no stronger than its grip where the robot touches something."""
        self._reaches = [model.body.reach for model in models]
        self._strikes = [model.body.reach if model.body.frame_width else 0.0 for model in models]
        """m from the axis to where a turning hull can strike; 0 for a round hull, which slides past."""
        self._gains = [max(model.drive.acceleration, model.drive.deceleration) * tick for model in models]
        self._boxes = [(box.x, box.y, box.half_x, box.half_y) for box in fixed_boxes(pitch, furniture)]
        self._free_x, self._free_y = pitch.goal_line, pitch.touch_line + pitch.border
        """m; no box of the pitch lies within these."""
        self._obstacles: list[tuple[float, float, float]] = []

    def set_obstacles(self, obstacles: Iterable[ObstacleState]) -> None:
        """Set the obstacles on the pitch."""
        self._obstacles = [(obstacle.x, obstacle.y, obstacle.radius) for obstacle in obstacles]

    def find(self, robots: Sequence[RobotState], ball: BallState | None) -> Candidates:
        """The robots that may meet another body within the tick."""
        tick, obstacles = self._tick, self._obstacles
        free_x, free_y = self._free_x - _MARGIN, self._free_y - _MARGIN
        ball_x, ball_y, _, ball_vx, ball_vy, _ = ball or _NOWHERE
        room = self._ball_radius + math.hypot(ball_vx, ball_vy) * tick + _MARGIN
        gains, strikes, reaches, yields = self._gains, self._strikes, self._reaches, self._yields
        moving, fixed, touching = [], [], set()
        for place, (x, y, _, _, vx, vy, omega, _) in enumerate(robots):
            extra = gains[place] + abs(omega) * strikes[place]
            speed = math.hypot(vx, vy) + extra
            travel = reaches[place] + speed * tick
            moving.append((x, y, vx, vy, extra, travel, place))
            near = travel + room
            if -near < ball_x - x < near and -near < ball_y - y < near and yields[place]:
                touching.add(place)  # another robot may press the ball against it
            if not (obstacles or abs(x) + travel > free_x or abs(y) + travel > free_y):
                continue
            near_by = self._fixed(x, y, travel + _MARGIN)
            if speed > MIN_IMPACT:
                fixed += [(place, number) for number, gap in near_by if gap < travel]
            if near_by and yields[place]:
                touching.add(place)
        hits, meeting = self._robots(moving)
        touching |= meeting
        return Candidates(hits, fixed, sorted(touching), bool(meeting))

    def _robots(self, moving: list[_Moving]) -> tuple[IndexPairs, set[int]]:
        """Pairs of robots that may hit each other, and the robots that yield among those that may touch."""
        widest, yields = max([travel for *_, travel, _ in moving], default=0.0) + _MARGIN, self._yields
        hits: IndexPairs = []
        touching: set[int] = set()
        moving.sort()
        for number, (x, y, vx, vy, extra, travel, one) in enumerate(moving, 1):
            for other_x, other_y, other_vx, other_vy, other_extra, other_way, other in moving[number:]:
                dx = other_x - x
                if dx > travel + widest:
                    break
                dy = other_y - y
                apart = math.hypot(dx, dy)
                if apart > travel + other_way + _MARGIN:
                    continue
                touching.update([place for place in (one, other) if yields[place]])
                if apart > travel + other_way:
                    continue
                approach = ((vx - other_vx) * dx + (vy - other_vy) * dy) / max(apart, 1e-9)
                approach += extra + other_extra
                if approach > MIN_IMPACT:
                    hits.append((min(one, other), max(one, other)))
        return sorted(hits), touching

    def _fixed(self, x: float, y: float, reach: float) -> list[tuple[int, float]]:
        """Fixed bodies that are less than `reach` m from a place, and how far they are."""
        found = []
        if abs(x) + reach > self._free_x or abs(y) + reach > self._free_y:
            for number, (at_x, at_y, half_x, half_y) in enumerate(self._boxes):
                dx, dy = abs(x - at_x) - half_x, abs(y - at_y) - half_y
                if dx < reach and dy < reach and (gap := math.hypot(max(dx, 0.0), max(dy, 0.0))) < reach:
                    found.append((number, gap))
        for number, (at_x, at_y, radius) in enumerate(self._obstacles, len(self._boxes)):
            if (gap := math.hypot(x - at_x, y - at_y) - radius) < reach:
                found.append((number, gap))
        return found
