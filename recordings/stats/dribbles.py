"""Dribbles: how often and how far robots carried the ball."""

import math
from dataclasses import dataclass

from recordings.stats.ball_control import touching
from recordings.stats.match_tick import MatchTick

MIN_DRIBBLE_M = 1.0
"""m; ours: a shorter way with the ball in hand is handling it, not a dribble."""
MAX_INTERRUPTION_S = 0.5
"""s; ours: a hold that is back within this, and that nobody else touched the ball in, is the same one."""


@dataclass(slots=True)
class DribbleStats:
    """One robot's."""

    count: int = 0
    distance: float = 0.0
    """m, of all of them."""
    longest: float = 0.0
    """m."""


@dataclass(slots=True)
class _Dribble:
    robot: str
    held_until: float
    distance: float = 0.0


class DribbleTracker:
    """Follows who carries the ball. A dribble begins with the hold and ends with the loss, a kick, or a stop."""

    def __init__(self) -> None:
        self.robots: dict[str, DribbleStats] = {}
        self._dribble: _Dribble | None = None

    def update(self, match_tick: MatchTick) -> None:
        """One more tick."""
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
        """What was carried so far is all."""
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
    """m that a robot drove in this tick."""
    before = match_tick.before.robots.get(robot) if match_tick.before is not None else None
    now = match_tick.world.robots.get(robot)
    if before is None or now is None or robot in match_tick.placed:
        return 0.0
    return math.hypot(now.x - before.x, now.y - before.y)
