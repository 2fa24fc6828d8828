"""The chassis of all robots: demanded velocities become field-frame velocities for each physics step of a tick."""

from collections.abc import Iterable, Iterator, Sequence

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive
from sim_host.actuation.omni_drive import OmniDrive
from sim_host.actuation.stuck_detector import StuckDetector
from sim_host.actuation.traction_drive import TractionDrive
from sim_host.actuation.velocity_drive import VelocityDrive
from sim_host.physics.engine import Engine
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotStates

_DirectDrive = VelocityDrive | TractionDrive
_DIRECT: dict[str, type[_DirectDrive]] = {"velocity": VelocityDrive, "traction": TractionDrive}
"""Drive models that set the velocity of the body."""
_MODELS = (*_DIRECT, "omni")
_Plan = Iterable[Sequence[FieldTwist]]
"""Velocities per physics step and robot."""


class Chassis:
    """Motion of all robots, in the order of the roster; each robot has the drive of its model."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel], engine: Engine) -> None:
        self._engine = engine
        self._steps = time.steps_per_tick
        driven = {name: [i for i, model in enumerate(models) if model.drive.model == name] for name in _MODELS}
        self._direct = [
            (indices, kind(time, [models[index] for index in indices]))
            for name, kind in _DIRECT.items()
            if (indices := driven[name])
        ]
        """Drives that plan a whole tick in one step: the indices of their robots, and the drive."""
        self._omni_driven = driven["omni"]
        self._omni = OmniDrive(time, [models[index] for index in self._omni_driven])
        self._detector = StuckDetector(models, time.tick)

    def reset(self) -> None:
        """Clear the memory: the next tick begins from the measured velocities."""
        for _, drive in self._direct:
            drive.reset()
        self._omni.reset()
        self._detector.reset()

    def stuck(self) -> list[bool]:
        """Per robot: it has made little of the progress that it demanded."""
        return self._detector.stuck()

    def plan(
        self, robots: RobotStates, inputs: Sequence[AppliedInput], touching: Sequence[int]
    ) -> Iterable[Sequence[FieldTwist]]:
        """The velocities of one tick, per physics step and robot; iterate to each step when it begins.

        `touching` are the robots that may touch another body in this tick.
        """
        demands = [one.drive for one in inputs]
        if len(self._direct) == 1 and not self._omni_driven:
            indices, drive = self._direct[0]
            return self._plan_directly(indices, drive, robots, demands, touching)
        plans = []
        for indices, drive in self._direct:
            its_robots, its_demands = RobotStates([robots[i] for i in indices]), [demands[i] for i in indices]
            plans.append((indices, iter(self._plan_directly(indices, drive, its_robots, its_demands, touching))))
        on_wheels = [robots[index] for index in self._omni_driven]
        their_demands = [demands[index] for index in self._omni_driven]
        self._omni.plan(on_wheels, their_demands)
        self._detector.update(self._omni_driven, self._omni.held_back, on_wheels, their_demands)
        return self._step_by_step(len(robots), plans)

    def _plan_directly(
        self,
        indices: list[int],
        drive: _DirectDrive,
        robots: RobotStates,
        demands: Sequence[Drive],
        touching: Sequence[int],
    ) -> _Plan:
        """The plan of one drive for its robots, which have these indices in the roster."""
        planned = drive.plan(robots, demands)
        self._detector.update(indices, drive.held_back, robots, demands)
        if not touching or isinstance(drive, VelocityDrive):
            return planned
        may_touch = [(robot, place) for robot, place in enumerate(indices) if place in touching]
        return drive.yielding(planned, may_touch, self._engine)

    def _step_by_step(
        self, count: int, plans: Sequence[tuple[list[int], Iterator[Sequence[FieldTwist]]]]
    ) -> Iterator[Sequence[FieldTwist]]:
        """Per physics step: the velocities of all robots, those on wheels from their present states."""
        now, driven = self._engine.robot_now, self._omni_driven
        for number in range(self._steps):
            twists = dict(zip(driven, self._omni.step(number, [now(index) for index in driven]), strict=True))
            for indices, planned in plans:
                twists.update(zip(indices, next(planned), strict=True))
            yield [twists[index] for index in range(count)]
