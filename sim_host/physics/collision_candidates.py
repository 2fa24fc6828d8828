"""Finds robots that could sink too deep into another body in one physics step, for `continuous_collision`."""

import math
from collections.abc import Iterable, Sequence

from schemas.config.robot_model import RobotModel
from schemas.config.sections import Pitch, TimeSteps
from sim_host.physics.pitch import fixed_boxes
from sim_host.snapshot import ObstacleState, RobotState

MAX_DEPTH = 0.01
"""m that a body may sink into another in one step: the engine's contacts undo this depth in a few steps."""
MIN_IMPACT = 0.5
"""m/s; robots that meet more slowly lean on each other, rather than hit each other."""

IndexPairs = list[tuple[int, int]]
_Moving = tuple[float, float, float, float, float, float, int]
"""x, y, vx, vy of a robot; the speed it may gain in the tick, m/s; how far it may reach, m; its index in the roster."""


class CollisionCandidates:
    """Finds robots that approach another body fast, once a tick; the cost grows with their number."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel], pitch: Pitch) -> None:
        self._tick = time.tick
        self._fast = MAX_DEPTH / time.physics_step
        self._reaches = [model.body.reach for model in models]
        self._strikes = [model.body.reach if model.body.frame_width else 0.0 for model in models]
        """m from the axis to where a turning hull can strike; 0 for a round hull, which slides past."""
        self._gains = [max(model.drive.acceleration, model.drive.deceleration) * time.tick for model in models]
        self._boxes = [(box.x, box.y, box.half_x, box.half_y) for box in fixed_boxes(pitch)]
        self._free_x, self._free_y = pitch.goal_line, pitch.touch_line + pitch.border
        """m; no box of the pitch lies within these."""
        self._obstacles: list[tuple[float, float, float]] = []

    def set_obstacles(self, obstacles: Iterable[ObstacleState]) -> None:
        """Set the obstacles on the pitch."""
        self._obstacles = [(obstacle.x, obstacle.y, obstacle.radius) for obstacle in obstacles]

    def find(self, robots: Sequence[RobotState]) -> tuple[IndexPairs, IndexPairs, IndexPairs]:
        """Pairs that may meet within the tick: of robots, too fast; of a robot and a fixed body, too fast; of robots.

        Fixed bodies are numbered: first the boxes of the pitch, then the obstacles. The last are all pairs of robots
        that may hit each other, those that are too fast among them.
        """
        fast, tick = self._fast, self._tick
        moving, fixed = [], []
        for place, (x, y, _, _, vx, vy, omega, _) in enumerate(robots):
            extra = self._gains[place] + abs(omega) * self._strikes[place]
            speed = math.hypot(vx, vy) + extra
            travel = self._reaches[place] + speed * tick
            moving.append((x, y, vx, vy, extra, travel, place))
            if speed > fast:
                fixed += self._fixed(place, x, y, travel)
        fast_pairs, hits = self._robots(moving)
        return fast_pairs, fixed, hits

    def _robots(self, moving: list[_Moving]) -> tuple[IndexPairs, IndexPairs]:
        widest = max([travel for *_, travel, _ in moving])
        pairs: IndexPairs = []
        hits: IndexPairs = []
        moving.sort()
        for number, (x, y, vx, vy, extra, travel, one) in enumerate(moving, 1):
            for other_x, other_y, other_vx, other_vy, other_extra, other_way, other in moving[number:]:
                dx = other_x - x
                if dx > travel + widest:
                    break
                dy = other_y - y
                apart = math.hypot(dx, dy)
                if apart > travel + other_way:
                    continue
                approach = ((vx - other_vx) * dx + (vy - other_vy) * dy) / max(apart, 1e-9)
                approach += extra + other_extra
                if approach > MIN_IMPACT:
                    pair = (min(one, other), max(one, other))
                    hits.append(pair)
                    if approach > self._fast:
                        pairs.append(pair)
        return sorted(pairs), sorted(hits)

    def _fixed(self, place: int, x: float, y: float, travel: float) -> IndexPairs:
        found = []
        if abs(x) + travel > self._free_x or abs(y) + travel > self._free_y:
            for number, (at_x, at_y, half_x, half_y) in enumerate(self._boxes):
                if math.hypot(max(abs(x - at_x) - half_x, 0.0), max(abs(y - at_y) - half_y, 0.0)) < travel:
                    found.append((place, number))
        for number, (at_x, at_y, radius) in enumerate(self._obstacles, len(self._boxes)):
            if math.hypot(x - at_x, y - at_y) - radius < travel:
                found.append((place, number))
        return found
