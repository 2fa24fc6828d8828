"""Drive with the ball no harder than the dribbler can follow.

The dribbler pulls the ball with a bounded force. The ball before the robot needs that pull when the robot brakes, and
when it turns: a turn at ω needs ω²·gap. Both together lose the ball, which either alone does not. A robot that drives
sideways meanwhile, so that it turns around the ball rather than around itself, needs no pull for the turn.
"""

import math

from robot_agent.sdk.bodies import Moving
from schemas.messages.command import Drive
from schemas.messages.setup import Setup

SHARE = 0.8
"""Part of the dribbler's force that is counted on: the rest is for noise, and for a ball that is not at the gap."""
AROUND = 0.7
"""How far a turn is one around the ball: 0 is around the robot's own centre, 1 around the ball."""
_LAG = 0.3
"""m/s by which the last demand may differ from the measured velocity and still count as the present one."""
_LEAST = 0.5
"""m/s²; the robot always brakes as hard as this."""


def keep_hold(me: Moving, wanted: Drive, last: Drive, time: float, setup: Setup) -> Drive:
    """The drive nearest to the wanted one with which the dribbler keeps the ball.

    Where a profile's dribbler holds the ball without bounded forces, the wanted one.

    Args:
        last: the drive of the last command.
        time: s since then.
    """
    dribble, ball = setup.dribble, setup.ball
    if dribble.method != "force":
        return wanted
    resists = ball.mass + ball.inertia / ball.radius**2
    pull, side = hold_deceleration(setup), SHARE * dribble.max_side / resists
    c, s = math.cos(me.heading), math.sin(me.heading)
    ahead = _near(last.vx, c * me.vx + s * me.vy)
    left = _near(last.vy, c * me.vy - s * me.vx)
    omega = _turn(wanted.omega, ahead, left, dribble.gap, pull, side)
    vy = wanted.vy - AROUND * omega * dribble.gap
    spare = pull - omega * (omega * dribble.gap + left)
    return Drive(vx=max(wanted.vx, ahead - max(_LEAST, spare) * time), vy=vy, omega=omega)


def hold_deceleration(setup: Setup) -> float:
    """How hard a robot may brake with the ball, m/s²; infinite where a profile's dribbler has no bounded forces."""
    dribble, ball = setup.dribble, setup.ball
    if dribble.method != "force":
        return math.inf
    return SHARE * dribble.max_pull / (ball.mass + ball.inertia / ball.radius**2)


def _near(demanded: float, measured: float) -> float:
    return max(measured - _LAG, min(measured + _LAG, demanded))


def _turn(wanted: float, ahead: float, left: float, gap: float, pull: float, side: float) -> float:
    """The turn rate nearest to the wanted one that pull and side force can follow, rad/s."""
    outward = math.copysign(left, wanted * left)  # m/s to the side to which it turns
    most = (math.sqrt(outward * outward + 4.0 * gap * pull) - outward) / (2.0 * gap)
    if abs(ahead) > 1e-6:
        most = min(most, side / abs(ahead))
    return max(-most, min(most, wanted))
