"""The velocity that a kick gives the ball: along the ground, as a lob under the bar, or with fixed loft."""

import math
from collections.abc import Callable
from typing import NamedTuple

from schemas.command import KickMode
from schemas.profile import Profile
from schemas.sections import Kicker
from sim_host.actuation.air import Air
from sim_host.actuation.lob import Aim, distance_to_goal_plane, solve
from sim_host.snapshot import BallState


class KickRefusedError(Exception):
    """The kick cannot be done; the sentence says why."""


class Launch(NamedTuple):
    """Velocity of the ball in the field frame at the start of its way, m/s."""

    vx: float
    vy: float
    vz: float


class Shot(NamedTuple):
    """A kick that is to be done: the ball, the kick axis, and the means."""

    speed: float
    """As asked for, m/s."""
    ball: BallState
    heading: float
    """Of the kick axis, rad, field frame."""
    kicker: Kicker
    profile: Profile


def launch(mode: KickMode, shot: Shot) -> Launch:
    """The velocity of the ball after a kick: the robot's own motion adds nothing to it (paper, equations 3 and 10).

    Raises:
        KickRefusedError: a lob that no way leads under the bar.
    """
    along, up = _WAYS[mode](shot)
    return Launch(along * math.cos(shot.heading), along * math.sin(shot.heading), up)


def _ground(shot: Shot) -> tuple[float, float]:
    """Paper, equation 3."""
    return min(shot.speed, shot.kicker.max_ground_speed), 0.0


def _loft(shot: Shot) -> tuple[float, float]:
    """As simatch kicks, but never faster than the device."""
    speed = min(shot.speed, shot.kicker.max_air_speed)
    return speed * math.cos(shot.kicker.loft), speed * math.sin(shot.kicker.loft)


def _lob(shot: Shot) -> tuple[float, float]:
    """Paper, equation 10, through the air of the profile."""
    profile, kicker, ball = shot.profile, shot.kicker, shot.ball
    pitch = profile.field
    d = distance_to_goal_plane(ball.x, shot.heading, pitch.goal_line)
    if not 0.0 < d < pitch.length * 2.0:
        raise KickRefusedError("kick: a lob is aimed at a goal, and this axis meets no goal line ahead")
    aim = Aim(pitch.goal_height, profile.ball.radius + kicker.lob_margin, ball.z)
    drag, step = Air.around(profile.ball).drag, profile.time.physics_step
    speeds = solve(d, aim, shot.speed, kicker.max_lob_speed, drag, step)
    if speeds is None or math.hypot(*speeds) > kicker.max_air_speed:
        raise KickRefusedError(
            f"kick: no lob goes the {d:.1f} m to the goal with the {kicker.max_air_speed:g} m/s there are; "
            "kick from nearer, or along the ground"
        )
    return speeds


_WAYS: dict[KickMode, Callable[[Shot], tuple[float, float]]] = {
    KickMode.GROUND: _ground,
    KickMode.LOB: _lob,
    KickMode.LOFT: _loft,
}
"""Mode → speeds along the ground and upward, m/s."""
