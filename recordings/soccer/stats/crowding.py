"""Crowds: how long several robots are close to the ball."""

import math

from recordings.soccer.stats.match_tick import MatchTick

RADIUS = 1.0
"""m from the centre of a robot to the ball's, on the ground, within which the robot is at the ball."""
CROWD = 3
"""Robots of both sides at the ball that make a crowd."""


class Crowding:
    """Measures the time for which a crowd was at the ball, while the ball was in play."""

    def __init__(self) -> None:
        self.seconds = 0.0
        self.longest = 0.0
        """Longest time in s without an interruption."""
        self._since = 0.0

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick."""
        if not match_tick.in_play or match_tick.before is None or not _is_crowded(match_tick):
            self._since = 0.0
            return
        self.seconds += match_tick.dt
        self._since += match_tick.dt
        self.longest = max(self.longest, self._since)


def _is_crowded(match_tick: MatchTick) -> bool:
    ball = match_tick.world.match_ball
    robots = match_tick.world.robots.values()
    near = [one for one in robots if one.off_field is None and math.hypot(one.x - ball.x, one.y - ball.y) <= RADIUS]
    return len(near) >= CROWD
