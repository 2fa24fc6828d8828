"""Dribbles: how often and how far robots carried the ball."""

import math
from dataclasses import dataclass

from recordings.soccer.stats.ball_control import touching
from recordings.soccer.stats.match_tick import MatchTick

MIN_DRIBBLE_M = 1.0
"""m; a shorter path with the ball is not a dribble. Chosen here."""
MAX_INTERRUPTION_S = 0.5
"""s for which a hold may be interrupted if no other robot touches the ball meanwhile. Chosen here."""


@dataclass(slots=True)
class DribbleStats:
    """Dribbles of one robot."""

    count: int = 0
    distance: float = 0.0
    """Total distance in m."""
    longest: float = 0.0
    """Distance of the longest one in m."""


@dataclass(slots=True)
class _Dribble:
    robot: str
    held_until: float
    distance: float = 0.0


class DribbleTracker:
    """Follows the robot with the ball. A dribble begins with the hold and ends with its loss, a kick, or STOP."""

    def __init__(self) -> None:
        self.robots: dict[str, DribbleStats] = {}
        self._dribble: _Dribble | None = None

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick."""
        holder, dribble = match_tick.world.possession, self._dribble
        if dribble is not None and _has_ended(match_tick, dribble):
            self.end()
            dribble = None
        if holder is None or not match_tick.running or match_tick.state is None or not match_tick.state.running:
            return
        if dribble is None:
            self._dribble = _Dribble(holder, match_tick.world.time)
            return
        dribble.distance += _distance_driven(match_tick, holder)
        dribble.held_until = match_tick.world.time

    def end(self) -> None:
        """End the current dribble, and count it if it is long enough."""
        dribble, self._dribble = self._dribble, None
        if dribble is not None and dribble.distance >= MIN_DRIBBLE_M:
            dribbles = self.robots.setdefault(dribble.robot, DribbleStats())
            dribbles.count += 1
            dribbles.distance += dribble.distance
            dribbles.longest = max(dribbles.longest, dribble.distance)


def _has_ended(match_tick: MatchTick, dribble: _Dribble) -> bool:
    world = match_tick.world
    return (
        match_tick.before is None
        or match_tick.state is None
        or not match_tick.state.running
        or world.kicked is not None
        or any(robot != dribble.robot for robot in touching(match_tick))
        or world.time - dribble.held_until > MAX_INTERRUPTION_S
    )


def _distance_driven(match_tick: MatchTick, robot: str) -> float:
    """Distance in m that a robot drove in this tick."""
    before = match_tick.before.robots.get(robot) if match_tick.before is not None else None
    now = match_tick.world.robots.get(robot)
    if before is None or now is None or robot in match_tick.placed:
        return 0.0
    return math.hypot(now.x - before.x, now.y - before.y)
