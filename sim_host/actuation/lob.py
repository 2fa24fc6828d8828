"""A lob: the velocity that takes the ball to a point below the bar, through the air that slows it.

The paper's parabola (equations 4 to 12) is where the search begins, and where it ends without drag. With drag the
flight is followed step by step as the engine integrates it, and the upward speed is corrected until it arrives.
"""

import math
from typing import NamedTuple

from sim_host.physics.gravity import GRAVITY

_FLAT = 1e-6
"""m; a lob that may not rise has no bound on its speed."""
_STEEPEST = 1.7
"""1 / cos of the angle, 54°, at which a lob may come down: a steeper one has to pass more than a ball's radius below h
to clear the bar."""
_TANGENT = 1.2
"""Of the angle, 50°, at which a parabola may come down: the air makes it steeper."""
_FASTER = 1.1
"""By what a lob that comes down too steeply is kicked faster along the ground, and how often that is tried."""
_ATTEMPTS = 12
_NEAR = 5e-4
"""m; an arrival this close to the point needs no correction."""
_CORRECTIONS = 12
"""At most; three or four do for a lob that a robot can kick."""
_LOST = 40.0
"""m below the start, where a ball that has not come to the goal plane never will."""


class Arrival(NamedTuple):
    """How a ball comes to the goal plane."""

    rise: float
    """Height above the start, m."""
    steepness: float
    """1 / cos of its angle to the ground."""
    time: float
    """s."""


class Aim(NamedTuple):
    """What a lob has to pass below; m."""

    bar: float
    """Ground to the lower face of the bar."""
    clearance: float
    """From the ball's centre to the bar: the ball's radius, and a margin."""
    start: float
    """Height of the ball's centre when it is kicked."""

    def rise(self, steepness: float = 1.0) -> float:
        """h: how far the ball's centre may rise to the goal plane.

        Paper, equation 5 (H − 2r from the ground), less a margin as in its code, for a ball that comes in level. One
        that comes down steeply has to pass lower to clear the edge of the bar. Never lower than it started.
        """
        return max(self.bar - self.start - self.clearance * steepness, 0.0)


def distance_to_goal_plane(x: float, heading: float, goal_line: float) -> float:
    """d: from the ball to where the kick axis meets a goal line's plane ahead, m; infinite when it meets none."""
    along = math.cos(heading)
    if abs(along) < 1e-9:
        return math.inf
    return (math.copysign(goal_line, along) - x) / along


def parabola(d: float, h: float, speed: float, step: float) -> tuple[float, float]:
    """Horizontal and vertical speed of a lob through (d, h) without drag, m/s.

    Paper, equations 8, 9 and 12. v_x is the speed asked for within two limits, both below the bound v_x < d·√(g/2h):
    half of it at most, the choice of the paper's code, so that the ball comes down through the goal plane well after
    its apex; and as much as keeps it from coming down too steeply. At a share q of the bound, a parabola comes down at
    the tangent (1/q² − 1)·h/d. The engine integrates semi-implicitly, so a flight of n steps of `step` s falls
    ½·g·t·(t + step); the solution is for that sum.
    """
    h_or_little = max(h, _FLAT)
    bound = d * math.sqrt(GRAVITY / (2.0 * h_or_little))
    slowest = bound / math.sqrt(1.0 + _TANGENT * d / h_or_little)
    along = max(min(speed, bound / 2.0), slowest)
    t = d / along
    return along, h / t + GRAVITY * (t + step) / 2.0


def fly(along: float, up: float, d: float, drag: float, step: float) -> Arrival | None:
    """The flight over `d` m in the engine's own steps, slowed by drag·speed²; nothing if it never arrives."""
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
    """Horizontal and vertical speed, m/s, of a lob that clears the edge of a bar `d` m away; nothing if there is none.

    `speed`: along the ground as asked for, m/s; a lob that would come down too steeply is kicked faster, up to
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
    """The upward speed near `up` with which a lob arrives at its point, and its flight: by the secant method."""
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
