"""The limits of a robot's drive, as applied to the demands for one robot; the drives of the host plan with the same."""

import math

from schemas.config.ramp import Ramp, TurnRamp
from schemas.config.robot_model import RobotModel
from schemas.messages.command import Drive, Kick, KickMode

_SAME = 1e-9
"""m/s and rad/s; demands that differ by no more are the same."""


def within_limits(demand: Drive, model: RobotModel) -> Drive:
    """A demand shortened to the top speeds of drive and wheels; the same object where it is within them.

    As in a match: `differential` loses sideways motion, and it and `omni` are shortened as a whole until the fastest
    rim is within its limit.
    """
    drive, wheels = model.drive, model.wheels
    vx, vy, omega = demand.vx, demand.vy if drive.sideways else 0.0, demand.omega
    if drive.model == "differential":
        scale = turn_scale = 1.0 / max(1.0, abs(vx) / drive.max_speed, abs(omega) / drive.max_turn_rate)
    else:
        scale = 1.0 / max(1.0, math.hypot(vx, vy) / drive.max_speed)
        turn_scale = 1.0 / max(1.0, abs(omega) / drive.max_turn_rate)
    vx, vy, omega = vx * scale, vy * scale, omega * turn_scale
    if drive.model in ("omni", "differential"):
        rims = 1.0 / max(1.0, max(map(abs, wheels.rim_speeds(vx, vy, omega))) / wheels.max_speed)
        vx, vy, omega = vx * rims, vy * rims, omega * rims
    excess = max(abs(vx - demand.vx), abs(vy - demand.vy), abs(omega - demand.omega))
    return Drive(vx=vx, vy=vy, omega=omega) if excess > _SAME else demand


def toward(now: Drive, demand: Drive, model: RobotModel, dt: float) -> Drive:
    """The demand, or as much of the way to it as the accelerations of the drive allow in `dt` s."""
    ((vx, vy),) = Ramp(model.drive, dt, 1).toward((now.vx, now.vy), (demand.vx, demand.vy))
    (omega,) = TurnRamp(model.drive, dt, 1).toward(now.omega, demand.omega)
    return Drive(vx=vx, vy=vy, omega=omega)


def kick_within_limits(kick: Kick, model: RobotModel) -> Kick:
    """A kick with at most the speed of the kicker; the same object where it is within it."""
    kicker = model.kicker
    top = {
        KickMode.GROUND: kicker.max_ground_speed,
        KickMode.LOB: kicker.max_lob_speed,
        KickMode.LOFT: kicker.max_air_speed,
    }[kick.mode]
    return kick if kick.speed <= top else Kick(mode=kick.mode, speed=top)
