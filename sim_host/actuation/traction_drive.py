"""The drive model `traction`: the velocity is set, and its change is limited as a vector in the field frame.

However a robot turns, no more than its grip acts on it: the change of its velocity, sideways or braking, is at most
`deceleration`, and its speed grows at most at `acceleration`. A robot that circles faster than that slides outward: its
velocity lags behind the demand, which turns with its body. A robot that may touch something yields to what is stronger
than its grip, in every physics step.
"""

import math
from collections.abc import Iterator, Sequence

from schemas.config.ramp import Planar
from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.frames import rotate
from schemas.messages.command import Drive
from sim_host.actuation.drive_model import Bodies, Plan
from sim_host.actuation.grip import Grip
from sim_host.actuation.set_motion import SetMotion, SetMotionDrive, slip_of
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState, RobotStates

_BARELY = 2.5e-4
"""The share of a change that counts as motion: a robot slower than this share of it gains speed in any direction."""


class _Traction(SetMotion):
    """The drive of one robot."""

    def __init__(self, time: TimeSteps, model: RobotModel) -> None:
        super().__init__(time, model)
        step = time.physics_step
        self._half_step = step / 2
        self._elapsed = [step * number for number in range(1, time.steps_per_tick + 1)]
        self._per_gain, self._per_grip = 1.0 / model.drive.acceleration, 1.0 / model.drive.deceleration
        self.grip = Grip.of(model, step)

    def plan(self, robot: RobotState, demand: Drive) -> list[FieldTwist]:
        """The velocity in each step of a tick. The demanded direction is taken at the heading halfway through it."""
        wanted = self._ramp.within_limits(demand.vx, demand.vy)
        turn = self._turning.within_limits(demand.omega)
        vx, vy, omega = self._now(robot, wanted, turn)
        turns = self._turning.toward(omega, turn)
        target = rotate(*wanted, robot.heading + self._half_step * sum(turns))
        ways = zip(self._toward((vx, vy), target), turns, strict=True)
        planned: list[FieldTwist] = [(x, y, rate) for (x, y), rate in ways]
        self.last = planned[-1]
        return planned

    def _now(self, robot: RobotState, wanted: Planar, wanted_turn: float) -> FieldTwist:
        """The motion as set, or near the measured one where the robot was disturbed; updates `held_back`.

        The plan of a disturbed robot leads its measured motion by as much as its grip changes in a step: one that is
        held back pushes with all its grip, and one that is let go has gained next to nothing.
        """
        self.held_back, last = False, self.last
        if last is None:
            return robot.vx, robot.vy, robot.omega
        slip = slip_of(last, robot)
        if slip is None:
            return last
        self.held_back = slip.holds_back(robot, wanted, wanted_turn)
        vx, vy, omega = last
        if slip.moving:
            lead = self.grip.change / max(slip.moving, self.grip.change)
            vx, vy = robot.vx + (vx - robot.vx) * lead, robot.vy + (vy - robot.vy) * lead
        if slip.turning:
            lead = self.grip.turn_change / max(slip.turning, self.grip.turn_change)
            omega = robot.omega + (omega - robot.omega) * lead
        return vx, vy, omega

    def _toward(self, now: Planar, target: Planar) -> list[Planar]:
        """Velocities after each step, on the way from the present one to the demanded one.

        The change along the motion and the change across it share the grip: half a circle for a robot that brakes, half
        an ellipse for one that gains speed.
        """
        (vx, vy), (x, y) = now, target
        dx, dy = x - vx, y - vy
        along_x, along_y = vx + _BARELY * dx, vy + _BARELY * dy
        ahead, aside = dx * along_x + dy * along_y, (dy * along_x - dx * along_y) * self._per_grip
        ahead *= self._per_gain if ahead > 0.0 else self._per_grip
        effort = math.hypot(ahead, aside)  # m/s · s: over the speed, it is how long the change takes
        rate = math.hypot(along_x, along_y) / effort if effort else math.inf
        shares = [elapsed * rate for elapsed in self._elapsed]
        return [target if share >= 1.0 else (vx + share * dx, vy + share * dy) for share in shares]


class TractionDrive(SetMotionDrive[_Traction]):
    """The drives of some robots."""

    yields = True
    one = _Traction

    def plan(self, robots: RobotStates, demands: Sequence[Drive], bodies: Bodies) -> Plan:
        """The velocities of one tick; robots that may touch something yield to what is stronger than their grip."""
        planned = super().plan(robots, demands, bodies)
        return self._yielding(planned, bodies) if bodies.touching else planned

    def _yielding(self, planned: Plan, bodies: Bodies) -> Iterator[list[FieldTwist]]:
        """The same plan, in which robots that may touch something change their motions by their grip at most."""
        places = [place for place, index in enumerate(bodies.indices) if index in bodies.touching]
        for step in planned:
            twists = list(step)
            for place in places:
                robot, measured = self.robots[place], bodies.engine.robot_twist(bodies.indices[place])
                twists[place] = robot.last = robot.grip.limited(twists[place], measured)
            yield twists
