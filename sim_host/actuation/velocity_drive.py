"""The drive model `velocity`: the robot moves with the planned velocity, within the limits of its drive."""

from schemas.config.ramp import Planar
from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.frames import rotate, to_body
from schemas.messages.command import Drive
from sim_host.actuation.set_motion import SetMotion, SetMotionDrive, slip_of
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState


class _Velocity(SetMotion):
    """The drive of one robot."""

    def __init__(self, time: TimeSteps, model: RobotModel) -> None:
        super().__init__(time, model)
        self._step = time.physics_step
        self._in_body: Planar = (0.0, 0.0)
        """The velocity that was set last, in the body frame: constant there, as with wheels that keep their speeds."""

    def plan(self, robot: RobotState, demand: Drive) -> list[FieldTwist]:
        """The velocity in each step of a tick."""
        wanted, turn = self._ramp.within_limits(demand.vx, demand.vy), self._turning.within_limits(demand.omega)
        velocity, omega = self._now(robot, wanted, turn)
        turns, ways = self._turning.toward(omega, turn), self._ramp.toward(velocity, wanted)
        planned: list[FieldTwist] = []
        heading = robot.heading
        for way, rate in zip(ways, turns, strict=True):
            planned.append((*rotate(*way, heading), rate))
            heading += rate * self._step
        self._in_body, self.last = ways[-1], planned[-1]
        return planned

    def _now(self, robot: RobotState, wanted: Planar, wanted_turn: float) -> tuple[Planar, float]:
        """Velocity in the body frame and turn rate, as set, or as measured where disturbed; updates `held_back`."""
        self.held_back, last = False, self.last
        if last is None:
            return to_body(robot.vx, robot.vy, robot.heading), robot.omega
        slip = slip_of(last, robot)
        if slip is None:
            return self._in_body, last[2]
        self.held_back = slip.holds_back(robot, wanted, wanted_turn)
        velocity = to_body(robot.vx, robot.vy, robot.heading) if slip.moving else self._in_body
        return velocity, robot.omega if slip.turning else last[2]


class VelocityDrive(SetMotionDrive[_Velocity]):
    """The drives of some robots."""

    one = _Velocity
