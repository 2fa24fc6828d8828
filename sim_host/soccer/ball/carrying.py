"""Three methods by which a held ball moves with its holder: by setting its pose, its velocity, or by forces.

The paper has two: `pose`, "directly and continuously set" before the robot (equation 2), and `velocity`, v + ω × r as
in its plugin. Both move the ball without fail, draw it to the gap no faster than `PULL_SPEED`, and release it when that
presses it into another body. `force` is the physical method: a spring and a damper, as strong as the dribbler's wheels,
draw the ball to the gap while it rolls on the ground and touches the hull. A ball that the wheels cannot hold in a turn
or under braking is lost. The wheels' pull on the robot, a thousandth of its weight, is neglected.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

from schemas.config.sections import Dribble
from sim_host.physics.vectors import FieldTwist, Vector
from sim_host.snapshot import BallState, RobotState

PULL_SPEED = 2.0
"""m/s; maximum speed, relative to the robot, at which a ball is drawn to its place before the robot."""


class CarryStep(NamedTuple):
    """The change of a held ball for one physics step; fields that are None are not changed."""

    place: Vector | None = None
    """m."""
    velocity: Vector | None = None
    """m/s; the ball rolls at it."""
    force: Vector | None = None
    """N, applied at its centre."""


class HeldBall(NamedTuple):
    """A held ball and its holder, before a step."""

    robot: RobotState
    drive: FieldTwist
    """vx, vy in m/s and omega in rad/s of the robot in this step, field frame."""
    ball: BallState
    dribble: Dribble
    ball_radius: float
    """m."""
    step: float
    """s."""

    def target_now(self) -> tuple[float, float]:
        """Place of the ball before the robot, now, m."""
        robot, gap = self.robot, self.dribble.gap
        return robot.x + gap * math.cos(robot.heading), robot.y + gap * math.sin(robot.heading)

    def target_next(self) -> tuple[float, float]:
        """Place of the ball before the robot, after the step, m."""
        robot, gap, (vx, vy, omega) = self.robot, self.dribble.gap, self.drive
        turned = robot.heading + omega * self.step
        return (robot.x + vx * self.step + gap * math.cos(turned), robot.y + vy * self.step + gap * math.sin(turned))


def by_pose(held: HeldBall) -> CarryStep:
    """Set pose and velocity to the gap's."""
    (x, y), (next_x, next_y), ball = held.target_now(), held.target_next(), held.ball
    dx, dy, dz = x - ball.x, y - ball.y, held.ball_radius - ball.z
    share = min(1.0, PULL_SPEED * held.step / max(math.hypot(dx, dy, dz), 1e-9))
    place = (ball.x + share * dx, ball.y + share * dy, ball.z + share * dz)
    return CarryStep(place=place, velocity=((next_x - x) / held.step, (next_y - y) / held.step, 0.0))


def by_velocity(held: HeldBall) -> CarryStep:
    """Set the velocity to v + ω × r, plus a velocity toward the gap."""
    robot, ball, (vx, vy, omega) = held.robot, held.ball, held.drive
    along = (vx - omega * (ball.y - robot.y), vy + omega * (ball.x - robot.x))
    x, y = held.target_next()
    pull = ((x - ball.x) / held.step - along[0], (y - ball.y) / held.step - along[1])
    share = min(1.0, PULL_SPEED / max(math.hypot(*pull), 1e-9))
    return CarryStep(velocity=(along[0] + share * pull[0], along[1] + share * pull[1], ball.vz))


def by_force(held: HeldBall) -> CarryStep:
    """Apply the force of a spring and a damper toward the gap, limited along and across the kick axis."""
    robot, ball, dribble, (vx, vy, omega) = held.robot, held.ball, held.dribble, held.drive
    x, y = held.target_now()
    faster = (vx - omega * (y - robot.y) - ball.vx, vy + omega * (x - robot.x) - ball.vy)
    fx = dribble.stiffness * (x - ball.x) + dribble.damping * faster[0]
    fy = dribble.stiffness * (y - ball.y) + dribble.damping * faster[1]
    c, s = math.cos(robot.heading), math.sin(robot.heading)
    along = max(-dribble.max_pull, min(dribble.max_pull, c * fx + s * fy))
    across = max(-dribble.max_side, min(dribble.max_side, c * fy - s * fx))
    return CarryStep(force=(c * along - s * across, s * along + c * across, 0.0))


METHODS: dict[str, Callable[[HeldBall], CarryStep]] = {"pose": by_pose, "velocity": by_velocity, "force": by_force}
"""`Dribble.method` → its function."""
