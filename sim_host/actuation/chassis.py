"""The chassis of all robots: demanded velocities become field-frame velocities for each physics step of a tick."""

from collections.abc import Callable, Iterable, Iterator, Sequence

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.applied import AppliedInput
from sim_host.actuation.omni_drive import OmniDrive
from sim_host.actuation.stuck_detector import StuckDetector
from sim_host.actuation.traction_drive import TractionDrive
from sim_host.actuation.velocity_drive import VelocityDrive
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState, RobotStates

_DIRECT: dict[str, type[VelocityDrive] | type[TractionDrive]] = {"velocity": VelocityDrive, "traction": TractionDrive}
"""Drive models that set the velocity of the body."""
_MODELS = (*_DIRECT, "omni")
Plan = tuple[list[int], list[list[FieldTwist]]]
"""Indices of robots, and their velocities per physics step."""


class Chassis:
    """Motion of all robots, in the order of the roster; each robot has the drive of its model."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel], now: Callable[[int], RobotState]) -> None:
        """`now` returns the state of a robot between two physics steps."""
        self._now = now
        self._steps = time.steps_per_tick
        driven = {name: [i for i, model in enumerate(models) if model.drive.model == name] for name in _MODELS}
        self._direct = [
            (indices, kind(time, [models[index] for index in indices]))
            for name, kind in _DIRECT.items()
            if (indices := driven[name])
        ]
        """Drives that plan a whole tick at once: the indices of their robots, and the drive."""
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

    def plan(self, robots: RobotStates, inputs: Sequence[AppliedInput]) -> Iterable[Sequence[FieldTwist]]:
        """The velocities of one tick, per physics step and robot; iterate to each step when it begins."""
        demands = [one.drive for one in inputs]
        if len(self._direct) == 1 and not self._omni_driven:
            indices, drive = self._direct[0]
            planned = drive.plan(robots, demands)
            self._detector.update(indices, drive.held_back, robots, demands)
            return planned
        plans = []
        for indices, drive in self._direct:
            its_robots, its_demands = RobotStates([robots[i] for i in indices]), [demands[i] for i in indices]
            plans.append((indices, drive.plan(its_robots, its_demands)))
            self._detector.update(indices, drive.held_back, its_robots, its_demands)
        on_wheels = [robots[index] for index in self._omni_driven]
        their_demands = [demands[index] for index in self._omni_driven]
        self._omni.plan(on_wheels, their_demands)
        self._detector.update(self._omni_driven, self._omni.held_back, on_wheels, their_demands)
        return self._step_by_step(len(robots), plans)

    def _step_by_step(self, count: int, plans: Sequence[Plan]) -> Iterator[Sequence[FieldTwist]]:
        """Per physics step: the velocities of all robots, those on wheels from their present states."""
        for number in range(self._steps):
            twists = dict(
                zip(
                    self._omni_driven,
                    self._omni.step(number, [self._now(index) for index in self._omni_driven]),
                    strict=True,
                )
            )
            for indices, planned in plans:
                twists.update(zip(indices, planned[number], strict=True))
            yield [twists[index] for index in range(count)]
