"""Dribbles: how often and how far robots carried the ball."""

import math
from dataclasses import dataclass

from recordings.stats.control import touching
from recordings.stats.moment import Moment

SHORTEST = 1.0
"""m; ours: a shorter way with the ball in hand is handling it, not a dribble."""
FLICKER = 0.5
"""s; ours: a hold that is back within this, and that nobody else touched the ball in, is the same one."""


@dataclass(slots=True)
class Dribbles:
    """One robot's."""

    count: int = 0
    distance: float = 0.0
    """m, of all of them."""
    longest: float = 0.0
    """m."""


@dataclass(slots=True)
class _Carry:
    robot: str
    held_until: float
    way: float = 0.0


class Carries:
    """Follows who carries the ball. A dribble begins with the hold and ends with the loss, a kick, or a stop."""

    def __init__(self) -> None:
        self.robots: dict[str, Dribbles] = {}
        self._carry: _Carry | None = None

    def take(self, moment: Moment) -> None:
        """One more tick."""
        holder, carry = moment.world.possession, self._carry
        if carry is not None and _is_over(moment, carry):
            self.end()
            carry = None
        if holder is None or not moment.running or moment.state is None or not moment.state.running:
            return
        if carry is None:
            self._carry = _Carry(holder, moment.world.time)
            return
        carry.way += _driven(moment, holder)
        carry.held_until = moment.world.time

    def end(self) -> None:
        """What was carried so far is all."""
        carry, self._carry = self._carry, None
        if carry is not None and carry.way >= SHORTEST:
            dribbles = self.robots.setdefault(carry.robot, Dribbles())
            dribbles.count += 1
            dribbles.distance += carry.way
            dribbles.longest = max(dribbles.longest, carry.way)


def _is_over(moment: Moment, carry: _Carry) -> bool:
    world = moment.world
    return (
        moment.before is None
        or moment.state is None
        or not moment.state.running
        or world.kicked is not None
        or any(robot != carry.robot for robot in touching(moment))
        or world.time - carry.held_until > FLICKER
    )


def _driven(moment: Moment, robot: str) -> float:
    """m that a robot drove in this tick."""
    before = moment.before.robots.get(robot) if moment.before is not None else None
    now = moment.world.robots.get(robot)
    if before is None or now is None or robot in moment.placed:
        return 0.0
    return math.hypot(now.x - before.x, now.y - before.y)
