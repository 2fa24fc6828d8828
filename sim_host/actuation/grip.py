"""The grip of robots that may touch something: how far a drive changes a measured motion in one physics step.

A drive whose velocity is set is as strong as it must be. A robot that touches another body therefore gets, in each
step, its measured velocity and a change toward the planned one that its wheels can bring about.
"""

import math
from collections.abc import Sequence

from schemas.config.robot_model import RobotModel
from sim_host.physics.vectors import FieldTwist


def accelerations(model: RobotModel) -> tuple[float, float]:
    """The greatest acceleration of a robot by the grip of its wheels, m/s², and its greatest turn acceleration, rad/s².

    The same force, at the arm of the wheels, turns the robot.
    """
    drive, body = model.drive, model.body
    grip = max(drive.acceleration, drive.deceleration)
    return grip, max(drive.turn_acceleration, body.mass * grip * model.wheels.arm / body.inertia_zz)


class Grip:
    """The grip of some robots."""

    def __init__(self, models: Sequence[RobotModel], step: float) -> None:
        """`step` is the physics step in s."""
        self.changes = [(grip * step, turn_grip * step) for grip, turn_grip in map(accelerations, models)]
        """Per robot: the greatest change of its velocity, m/s, and of its turn rate, rad/s, in one step."""

    def limited(self, robot: int, planned: FieldTwist, measured: FieldTwist) -> FieldTwist:
        """The motion nearest to the planned one that the robot's grip can make of the measured one in a step."""
        most, most_turn = self.changes[robot]
        (vx, vy, omega), (now_x, now_y, now_omega) = planned, measured
        dx, dy, turn = vx - now_x, vy - now_y, omega - now_omega
        change = math.hypot(dx, dy)
        if change <= most and abs(turn) <= most_turn:
            return planned
        share = min(1.0, most / max(change, most))
        return [now_x + share * dx, now_y + share * dy, now_omega + max(-most_turn, min(most_turn, turn))]
