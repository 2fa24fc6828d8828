"""The velocity of a lob: it takes the ball to a point below the bar, through the drag of the air.

The search begins with the paper's parabola (equations 4 to 12), which is the solution without drag. With drag, the
flight is computed step by step as the engine integrates it, and the upward speed is corrected until the ball arrives at
the point.
"""

import math
from typing import NamedTuple

from schemas.config.rolling import GRAVITY

_FLAT = 1e-6
"""m; the smallest rise in the bound on the speed, which is infinite for a lob that may not rise."""
_STEEPEST = 1.7
"""1 / cos of the steepest angle, 54°, at which a lob may come down: a steeper one would have to pass more than a ball's
radius below h to clear the bar."""
_TANGENT = 1.2
"""Tangent of the steepest angle, 50°, at which the parabola may come down: drag makes the flight steeper."""
_FASTER = 1.1
"""Factor on the horizontal speed of a lob that comes down too steeply, in each of `_ATTEMPTS` attempts."""
_ATTEMPTS = 12
_NEAR = 5e-4
"""m; an arrival this close to the point needs no correction."""
_CORRECTIONS = 12
"""At most; three or four are enough for a lob within a robot's speed."""
_LOST = 40.0
"""m below the start; a ball that has fallen this far has missed the goal plane."""


class Arrival(NamedTuple):
    """The arrival of a ball at the goal plane."""

    rise: float
    """Height above the start, m."""
    steepness: float
    """1 / cos of its angle to the ground."""
    time: float
    """s."""


class Aim(NamedTuple):
    """The bar that a lob has to pass below; m."""

    bar: float
    """Ground to the lower face of the bar."""
    clearance: float
    """From the ball's centre to the bar: the ball's radius, and a margin."""
    start: float
    """Height of the ball's centre when it is kicked."""

    def rise(self, steepness: float = 1.0) -> float:
        """h: the rise of the ball's centre from its start to the goal plane; at least 0.

        For a ball that arrives level, this is equation 5 of the paper (H − 2r from the ground), less a margin as in its
        code. A ball that comes down steeply has to pass lower to clear the edge of the bar.
        """
        return max(self.bar - self.start - self.clearance * steepness, 0.0)


def distance_to_goal_plane(x: float, heading: float, goal_line: float) -> float:
    """d: from the ball along the kick axis to the plane of a goal line ahead, m; infinite if it meets none."""
    along = math.cos(heading)
    if abs(along) < 1e-9:
        return math.inf
    return (math.copysign(goal_line, along) - x) / along


def parabola(d: float, h: float, speed: float, step: float) -> tuple[float, float]:
    """Horizontal and vertical speed of a lob through (d, h) without drag, m/s.

    Paper, equations 8, 9 and 12. v_x is the requested speed within two limits, both below the bound v_x < d·√(g/2h).
    It is at most half of the bound, as in the paper's code, so that the ball passes the goal plane well after its apex.
    It is at least so high that the ball does not come down too steeply: at a share q of the bound, a parabola comes
    down at the tangent (1/q² − 1)·h/d. The engine integrates semi-implicitly, so that a flight in steps of `step` s
    falls ½·g·t·(t + step); the solution is for that sum.
    """
    h_or_little = max(h, _FLAT)
    bound = d * math.sqrt(GRAVITY / (2.0 * h_or_little))
    slowest = bound / math.sqrt(1.0 + _TANGENT * d / h_or_little)
    along = max(min(speed, bound / 2.0), slowest)
    t = d / along
    return along, h / t + GRAVITY * (t + step) / 2.0


def fly(along: float, up: float, d: float, drag: float, step: float) -> Arrival | None:
    """The flight over `d` m in the engine's own steps, slowed by drag·speed²; None if it never arrives."""
    x = z = time = 0.0
    pull, vx, vz = GRAVITY * step, along, up
    while True:
        slowing = drag * math.sqrt(vx * vx + vz * vz) * step
        new_vx, new_vz = vx - slowing * vx, vz - slowing * vz - pull
        if x + new_vx * step >= d:
            break
        vx, vz = new_vx, new_vz
        x, z, time = x + vx * step, z + vz * step, time + step
        if z < -_LOST:
            return None
    left = (d - x) / new_vx
    down = vz + (new_vz - vz) * left / step
    return Arrival(z + new_vz * left, math.hypot(new_vx, down) / new_vx, time + left)


def solve(d: float, aim: Aim, speed: float, fastest: float, drag: float, step: float) -> tuple[float, float] | None:
    """Horizontal and vertical speed, m/s, of a lob that passes below a bar `d` m away; None if there is none.

    `speed`: the requested horizontal speed, m/s; a lob that would come down too steeply is kicked faster, up to
    `fastest`. `drag`: 1/m; `step`: s.
    """
    along, up = parabola(d, aim.rise(), speed, step)
    along = min(along, fastest)
    for _ in range(_ATTEMPTS):
        corrected = _corrected(along, up, d, aim, drag, step)
        if corrected is not None:
            up, arrival = corrected
            if arrival.steepness <= _STEEPEST or along == fastest:
                return along, up
        along = min(along * _FASTER, fastest)
    return None


def _corrected(along: float, up: float, d: float, aim: Aim, drag: float, step: float) -> tuple[float, Arrival] | None:
    """The upward speed near `up` with which a lob arrives at its point, by the secant method, and its arrival."""
    last: tuple[float, float] | None = None
    for _ in range(_CORRECTIONS):
        arrival = fly(along, up, d, drag, step)
        if arrival is None:
            return None
        miss = aim.rise(arrival.steepness) - arrival.rise
        if abs(miss) < _NEAR:
            return up, arrival
        gain = arrival.time if last is None else (last[1] - miss) / (up - last[0])  # m of rise for each m/s upward
        last = (up, miss)
        up += miss / gain
    return None
