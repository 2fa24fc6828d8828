"""The velocity that a kick gives the ball: along the ground, as a lob under the bar, or with fixed loft."""

import math
from collections.abc import Callable
from typing import NamedTuple

from schemas.config.profile import Profile
from schemas.config.sections import Kicker
from schemas.messages.command import KickMode
from sim_host.snapshot import BallState
from sim_host.soccer.ball.aerodynamics import Aerodynamics
from sim_host.soccer.ball.lob import Aim, distance_to_goal_plane, solve


class KickRefusedError(Exception):
    """The kick cannot be carried out; the message is the reason."""


class Launch(NamedTuple):
    """Velocity of the ball in the field frame right after the kick, m/s."""

    vx: float
    vy: float
    vz: float


class PlannedKick(NamedTuple):
    """A kick that is about to be carried out: speed, ball, kick axis and kicker."""

    speed: float
    """The requested speed, m/s."""
    ball: BallState
    heading: float
    """Of the kick axis, rad, field frame."""
    kicker: Kicker
    profile: Profile


def launch(mode: KickMode, kick: PlannedKick) -> Launch:
    """The velocity of the ball after a kick; the robot's own motion adds nothing to it (paper, equations 3 and 10).

    Raises:
        KickRefusedError: no possible lob passes under the bar.
    """
    along, up = _MODES[mode](kick)
    return Launch(along * math.cos(kick.heading), along * math.sin(kick.heading), up)


def _ground(kick: PlannedKick) -> tuple[float, float]:
    """Along the ground (paper, equation 3)."""
    return min(kick.speed, kick.kicker.max_ground_speed), 0.0


def _loft(kick: PlannedKick) -> tuple[float, float]:
    """With a fixed elevation, as in simatch, but never faster than the kicker allows."""
    speed = min(kick.speed, kick.kicker.max_air_speed)
    return speed * math.cos(kick.kicker.loft), speed * math.sin(kick.kicker.loft)


def _lob(kick: PlannedKick) -> tuple[float, float]:
    """A lob under the bar (paper, equation 10), with the drag of the profile's air."""
    profile, kicker, ball = kick.profile, kick.kicker, kick.ball
    pitch = profile.field
    d = distance_to_goal_plane(ball.x, kick.heading, pitch.goal_line)
    if not 0.0 < d < pitch.length * 2.0:
        raise KickRefusedError("kick: a lob is aimed at a goal, and the kick axis meets no goal line ahead")
    aim = Aim(pitch.goal_height, profile.ball.radius + kicker.lob_margin, ball.z)
    drag, step = Aerodynamics.of_ball(profile.ball).drag, profile.time.physics_step
    speeds = solve(d, aim, kick.speed, kicker.max_lob_speed, drag, step)
    if speeds is None or math.hypot(*speeds) > kicker.max_air_speed:
        raise KickRefusedError(
            f"kick: no lob reaches the goal, {d:.1f} m away, with at most {kicker.max_air_speed:g} m/s; "
            "kick from nearer, or along the ground"
        )
    return speeds


_MODES: dict[KickMode, Callable[[PlannedKick], tuple[float, float]]] = {
    KickMode.GROUND: _ground,
    KickMode.LOB: _lob,
    KickMode.LOFT: _loft,
}
"""Mode → speeds along the ground and upward, m/s."""
