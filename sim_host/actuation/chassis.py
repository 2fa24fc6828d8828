"""The chassis of all robots: what they were told becomes field-frame velocities for each physics step of a tick."""

from collections.abc import Callable, Iterable, Iterator, Sequence

from schemas.host import AppliedInput
from schemas.robot_model import RobotModel
from schemas.sections import TimeSteps
from sim_host.actuation.drive import FieldDrive
from sim_host.actuation.omni_drive import OmniDrive
from sim_host.actuation.stuck import StuckWatch
from sim_host.actuation.velocity_drive import VelocityDrive
from sim_host.snapshot import Robots, RobotState


class Chassis:
    """Motion of all robots, in the order of the roster; each robot has the drive of its model."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel], now: Callable[[int], RobotState]) -> None:
        """`now` tells how one robot moves between two physics steps."""
        self._now = now
        self._set = [place for place, model in enumerate(models) if model.drive.model == "velocity"]
        self._rolling = [place for place, model in enumerate(models) if model.drive.model == "omni"]
        self._velocity = VelocityDrive(time, [models[place] for place in self._set])
        self._omni = OmniDrive(time, [models[place] for place in self._rolling])
        self._watch = StuckWatch(len(models), time.tick)

    def forget(self) -> None:
        """Remember nothing: the robots' velocities are what is measured."""
        self._velocity.forget()
        self._omni.forget()
        self._watch.forget()

    def stuck(self) -> list[bool]:
        """Per robot: it has long moved much slower than it should."""
        return self._watch.stuck()

    def plan(self, robots: Robots, inputs: Sequence[AppliedInput]) -> Iterable[Sequence[FieldDrive]]:
        """The drives of one tick: per physics step, per robot. Each is to be asked for when its step begins."""
        told = [one.drive for one in inputs]
        if not self._rolling:
            planned = self._velocity.plan(robots, told)
            self._watch.note(self._set, self._velocity.held)
            return planned
        planned = self._velocity.plan(
            Robots([robots[place] for place in self._set]), [told[place] for place in self._set]
        )
        self._omni.plan([robots[place] for place in self._rolling], [told[place] for place in self._rolling])
        self._watch.note(self._set, self._velocity.held)
        self._watch.note(self._rolling, self._omni.held)
        return self._step_by_step(planned)

    def _step_by_step(self, planned: Sequence[Sequence[FieldDrive]]) -> Iterator[Sequence[FieldDrive]]:
        for number, set_velocities in enumerate(planned):
            rolled = self._omni.step(number, [self._now(place) for place in self._rolling])
            drives = dict(zip(self._set + self._rolling, (*set_velocities, *rolled), strict=True))
            yield [drives[place] for place in range(len(drives))]
