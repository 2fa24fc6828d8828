"""The velocity that a kick gives the ball: along the ground, or as a lob solved to pass under the bar."""

import math
from typing import NamedTuple

from schemas.command import Kick, KickMode
from schemas.profile import Field, Kicker, Profile

GRAVITY = 9.81
"""m/s², simatch world file."""

_FLAT = 1e-6
"""m; a lob that may not rise has no bound on its speed."""
_ROUNDS = 4
"""Rounds in which a lob's height and its angle of descent agree to a millimetre."""


class KickRefusedError(Exception):
    """The kick cannot be done; the sentence says why."""


class Launch(NamedTuple):
    """Velocity of the ball in the field frame at the start of its way, m/s."""

    vx: float
    vy: float
    vz: float


def lob_rise(pitch: Field, ball_radius: float, margin: float, steepness: float = 1.0) -> float:
    """h: how far the ball's centre may rise to the goal plane, m.

    Paper, equation 5, less a margin as in its code, for a ball that comes in level. One that comes down steeply has
    to pass lower to clear the edge of the bar: `steepness` is 1 / cos of its angle of descent.
    """
    return pitch.goal_height - ball_radius - (ball_radius + margin) * steepness


def distance_to_goal_plane(x: float, heading: float, goal_line: float) -> float:
    """d: from the ball to where the kick axis meets a goal line's plane ahead, m; infinite when it meets none."""
    along = math.cos(heading)
    if abs(along) < 1e-9:
        return math.inf
    return (math.copysign(goal_line, along) - x) / along


def solve_lob(d: float, h: float, speed: float, step: float) -> tuple[float, float]:
    """Horizontal and vertical speed of a lob through (d, h), m/s.

    Paper, equations 8, 9 and 12. v_x stays at half the bound v_x < d·√(g/2h) at most, the choice of the paper's
    code: the ball then comes down through the goal plane well after its apex. The engine integrates
    semi-implicitly, so a flight of n steps of `step` s falls ½·g·t·(t + step); the solution is for that sum.
    """
    fastest = d * math.sqrt(GRAVITY / (2.0 * max(h, _FLAT))) / 2.0
    along = min(speed, fastest)
    t = d / along
    return along, h / t + GRAVITY * (t + step) / 2.0


def launch(kick: Kick, ball_x: float, heading: float, kicker: Kicker, profile: Profile) -> Launch:
    """The velocity of a ball at `ball_x` m after a kick along `heading`.

    Ground: paper, equation 3. Lob: paper, equation 10.

    Raises:
        KickRefusedError: a lob whose axis meets no goal plane ahead.
    """
    c, s = math.cos(heading), math.sin(heading)
    pitch = profile.field
    if kick.mode is KickMode.GROUND:
        speed = min(kick.speed, kicker.max_ground_speed)
        return Launch(speed * c, speed * s, 0.0)
    d = distance_to_goal_plane(ball_x, heading, pitch.goal_line)
    if not 0.0 < d < pitch.length * 2.0:
        raise KickRefusedError("kick: a lob is aimed at a goal, and this axis meets no goal line ahead")
    along, up = lob(d, min(kick.speed, kicker.max_lob_speed), kicker.lob_margin, profile)
    return Launch(along * c, along * s, up)


def lob(d: float, speed: float, margin: float, profile: Profile) -> tuple[float, float]:
    """Horizontal and vertical speed, m/s, of a lob that clears the bar's edge at `d` m."""
    p, step = profile, profile.time.physics_step
    steepness = 1.0
    for _ in range(_ROUNDS):
        h = max(lob_rise(p.field, p.ball.radius, margin, steepness), 0.0)
        along, up = solve_lob(d, h, speed, step)
        down = up - GRAVITY * (d / along + step)
        steepness = math.hypot(along, down) / along
    return along, up
