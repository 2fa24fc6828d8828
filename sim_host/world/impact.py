"""Which robots could run so deep into another body in one physics step that they have to be brought to it first."""

import math
from collections.abc import Iterable, Sequence

from schemas.robot_model import RobotModel
from schemas.sections import Field, TimeSteps
from sim_host.snapshot import ObstacleState, RobotState
from sim_host.world.pitch import fixed_boxes

DEEP = 0.01
"""m that a body may sink into another in one step: what the engine's contacts take away again in a few."""

Pairs = list[tuple[int, int]]
Moving = tuple[float, float, float, float, float, float, int]
"""x, y, vx, vy of a robot; what the tick may add to its speed, m/s; how far it may get, m; its place in the roster."""


class Impacts:
    """Looks for robots that close in fast, once a tick; costs less the fewer there are."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel], pitch: Field) -> None:
        self._tick = time.tick
        self._fast = DEEP / time.physics_step
        self._reaches = [model.body.reach for model in models]
        self._strikes = [model.body.reach if model.body.frame_width else 0.0 for model in models]
        """m from the axis at which a turning hull strikes; a round one slides past."""
        self._gains = [max(model.drive.acceleration, model.drive.deceleration) * time.tick for model in models]
        self._boxes = [(box.x, box.y, box.half_x, box.half_y) for box in fixed_boxes(pitch)]
        self._free_x, self._free_y = pitch.goal_line, pitch.touch_line + pitch.border
        """m; inside these there is no box of the pitch."""
        self._obstacles: list[tuple[float, float, float]] = []

    def stand(self, obstacles: Iterable[ObstacleState]) -> None:
        """Take note of what stands on the pitch."""
        self._obstacles = [(obstacle.x, obstacle.y, obstacle.radius) for obstacle in obstacles]

    def due(self, robots: Sequence[RobotState]) -> tuple[Pairs, Pairs]:
        """Pairs of robots, and pairs of a robot and a fixed body, that may meet too fast within the tick.

        Fixed bodies are counted through: the boxes of the pitch, then the obstacles.
        """
        fast, tick = self._fast, self._tick
        moving, fixed = [], []
        for place, (x, y, _, _, vx, vy, omega, _) in enumerate(robots):
            extra = self._gains[place] + abs(omega) * self._strikes[place]
            speed = math.hypot(vx, vy) + extra
            way = self._reaches[place] + speed * tick
            moving.append((x, y, vx, vy, extra, way, place))
            if speed > fast:
                fixed += self._fixed(place, x, y, way)
        return self._robots(moving), fixed

    def _robots(self, moving: list[Moving]) -> Pairs:
        widest, pairs = max([way for *_, way, _ in moving]), []
        moving.sort()
        for number, (x, y, vx, vy, extra, way, one) in enumerate(moving, 1):
            for other_x, other_y, other_vx, other_vy, others, other_way, other in moving[number:]:
                dx = other_x - x
                if dx > way + widest:
                    break
                dy = other_y - y
                apart = math.hypot(dx, dy)
                if apart > way + other_way:
                    continue
                approach = ((vx - other_vx) * dx + (vy - other_vy) * dy) / max(apart, 1e-9)
                if approach + extra + others > self._fast:
                    pairs.append((min(one, other), max(one, other)))
        return sorted(pairs)

    def _fixed(self, place: int, x: float, y: float, way: float) -> Pairs:
        found = []
        if abs(x) + way > self._free_x or abs(y) + way > self._free_y:
            for number, (at_x, at_y, half_x, half_y) in enumerate(self._boxes):
                if math.hypot(max(abs(x - at_x) - half_x, 0.0), max(abs(y - at_y) - half_y, 0.0)) < way:
                    found.append((place, number))
        for number, (at_x, at_y, radius) in enumerate(self._obstacles, len(self._boxes)):
            if math.hypot(x - at_x, y - at_y) - radius < way:
                found.append((place, number))
        return found
