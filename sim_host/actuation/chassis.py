"""The chassis of all robots: demanded velocities become field-frame velocities for each physics step of a tick."""

from collections.abc import Callable, Iterable, Iterator, Sequence

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.applied import AppliedInput
from sim_host.actuation.omni_drive import OmniDrive
from sim_host.actuation.stuck_detector import StuckDetector
from sim_host.actuation.velocity_drive import VelocityDrive
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState, RobotStates


class Chassis:
    """Motion of all robots, in the order of the roster; each robot has the drive of its model."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel], now: Callable[[int], RobotState]) -> None:
        """`now` returns the state of a robot between two physics steps."""
        self._now = now
        self._velocity_driven = [index for index, model in enumerate(models) if model.drive.model == "velocity"]
        self._omni_driven = [index for index, model in enumerate(models) if model.drive.model == "omni"]
        self._velocity = VelocityDrive(time, [models[index] for index in self._velocity_driven])
        self._omni = OmniDrive(time, [models[index] for index in self._omni_driven])
        self._detector = StuckDetector(len(models), time.tick)

    def reset(self) -> None:
        """Clear the memory: the next tick begins from the measured velocities."""
        self._velocity.reset()
        self._omni.reset()
        self._detector.reset()

    def stuck(self) -> list[bool]:
        """Per robot: it has moved much slower than demanded for some time."""
        return self._detector.stuck()

    def plan(self, robots: RobotStates, inputs: Sequence[AppliedInput]) -> Iterable[Sequence[FieldTwist]]:
        """The velocities of one tick, per physics step and robot; iterate to each step when it begins."""
        demands = [one.drive for one in inputs]
        if not self._omni_driven:
            planned = self._velocity.plan(robots, demands)
            self._detector.update(self._velocity_driven, self._velocity.held_back)
            return planned
        planned = self._velocity.plan(
            RobotStates([robots[index] for index in self._velocity_driven]),
            [demands[index] for index in self._velocity_driven],
        )
        self._omni.plan([robots[index] for index in self._omni_driven], [demands[index] for index in self._omni_driven])
        self._detector.update(self._velocity_driven, self._velocity.held_back)
        self._detector.update(self._omni_driven, self._omni.held_back)
        return self._step_by_step(planned)

    def _step_by_step(self, planned: Sequence[Sequence[FieldTwist]]) -> Iterator[Sequence[FieldTwist]]:
        for number, of_velocity_drives in enumerate(planned):
            of_omni_drives = self._omni.step(number, [self._now(index) for index in self._omni_driven])
            drives = dict(
                zip(self._velocity_driven + self._omni_driven, (*of_velocity_drives, *of_omni_drives), strict=True)
            )
            yield [drives[index] for index in range(len(drives))]
