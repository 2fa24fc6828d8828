"""The grip of robots that may touch something: how far a drive changes a measured motion in one physics step.

A drive whose velocity is set is as strong as it must be. A robot that touches another body therefore gets, in each
step, its measured velocity and a change toward the planned one that its wheels can bring about.
"""

import math
from typing import NamedTuple, Self

from schemas.config.robot_model import RobotModel
from sim_host.physics.vectors import FieldTwist


class Grip(NamedTuple):
    """The grip of one robot: by how much its motion changes in one physics step at most."""

    change: float
    """Of its velocity, m/s."""
    turn_change: float
    """Of its turn rate, rad/s; at least that of the same force at the arm of the wheels."""

    @classmethod
    def of(cls, model: RobotModel, step: float) -> Self:
        """The grip of a model; `step` is the physics step in s."""
        drive, body = model.drive, model.body
        grip = max(drive.acceleration, drive.deceleration)
        turn_grip = max(drive.turn_acceleration, body.mass * grip * model.wheels.arm / body.inertia_zz)
        return cls(grip * step, turn_grip * step)

    def limited(self, planned: FieldTwist, measured: FieldTwist) -> FieldTwist:
        """The motion nearest to the planned one that the grip can make of the measured one in a step."""
        (vx, vy, omega), (now_x, now_y, now_omega) = planned, measured
        dx, dy, turn = vx - now_x, vy - now_y, omega - now_omega
        change = math.hypot(dx, dy)
        if change <= self.change and abs(turn) <= self.turn_change:
            return planned
        share = self.change / max(change, self.change)
        turn = max(-self.turn_change, min(self.turn_change, turn))
        return [now_x + share * dx, now_y + share * dy, now_omega + turn]
