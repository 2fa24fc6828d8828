"""Distance and speed of every robot."""

import math
from dataclasses import dataclass

from recordings.soccer.stats.match_tick import MatchTick
from schemas.messages.world import RobotTruth

MAX_SPEED = 12.0
"""m/s; a robot with a longer step was placed by hand: no robot of the league is half as fast. Chosen here."""


@dataclass(slots=True)
class MotionStats:
    """Motion of one robot, in m, s and m/s."""

    distance: float = 0.0
    """Length of the path of its centre while it is on the field."""
    clock_distance: float = 0.0
    """The part of it while the game clock ran."""
    in_play_distance: float = 0.0
    """The part of it while the ball was in play."""
    in_play: float = 0.0
    """Time on the field while the ball was in play."""
    top_speed: float = 0.0
    longest_stuck: float = 0.0
    """Longest time in s for which the host reported it as stuck."""

    @property
    def mean_speed(self) -> float:
        """Mean speed while the ball was in play."""
        return self.in_play_distance / self.in_play if self.in_play > 0 else 0.0


class MotionTracker:
    """Follows all robots, by name, in the order of their appearance."""

    def __init__(self) -> None:
        self.robots: dict[str, MotionStats] = {}
        self._stuck: dict[str, float] = {}
        """Robot → time in s for which it has been stuck."""

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick."""
        before, dt, in_play = match_tick.before, match_tick.dt, match_tick.in_play
        clock_runs = before is not None and match_tick.world.clock > before.clock
        for name, robot in match_tick.world.robots.items():
            motion = self.robots.get(name)
            if motion is None:
                motion = self.robots[name] = MotionStats()
            if robot.off_field is not None:
                self._stuck[name] = 0.0
                continue
            self._stuck[name] = self._stuck.get(name, 0.0) + dt if robot.stuck else 0.0
            motion.longest_stuck = max(motion.longest_stuck, self._stuck[name])
            motion.top_speed = max(motion.top_speed, math.hypot(robot.vx, robot.vy))
            last = before.robots.get(name) if before is not None else None
            if last is None or last.off_field is not None:
                continue
            step = 0.0 if name in match_tick.placed else _step(last, robot, dt)
            motion.distance += step
            if clock_runs:
                motion.clock_distance += step
            if in_play:
                motion.in_play += dt
                motion.in_play_distance += step


def _step(before: RobotTruth, now: RobotTruth, dt: float) -> float:
    step = math.hypot(now.x - before.x, now.y - before.y)
    return step if step <= MAX_SPEED * dt else 0.0
