"""The chassis of all robots: demanded velocities become field-frame velocities for each physics step of a tick."""

from collections.abc import Iterator, Sequence

from schemas.config.robot_model import RobotModel
from schemas.config.sections import TimeSteps
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive
from sim_host.actuation.drive_model import Bodies, DriveModel, Plan
from sim_host.actuation.drives import DRIVES
from sim_host.actuation.stuck_detector import StuckDetector
from sim_host.physics.engine import Engine
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotStates


class Chassis:
    """Motion of all robots, in the order of the roster; each robot has the drive of its model."""

    def __init__(self, time: TimeSteps, models: Sequence[RobotModel], engine: Engine) -> None:
        self._engine, self._steps = engine, time.steps_per_tick
        self._models = models
        self._drives: list[tuple[list[int], DriveModel]] = []
        """The indices of a drive's robots, and the drive."""
        for name, kind in DRIVES.items():
            if indices := [index for index, model in enumerate(models) if model.drive.model == name]:
                self._drives.append((indices, kind(time, [models[index] for index in indices])))
        self._detector = StuckDetector(models, time.tick)

    def reset(self) -> None:
        """Clear the memory: the next tick begins from the measured velocities."""
        for _, drive in self._drives:
            drive.reset()
        self._detector.reset()

    @property
    def yielding(self) -> list[bool]:
        """Per robot: its drive asks whether it may touch something, and yields to what is stronger."""
        return [DRIVES[model.drive.model].yields for model in self._models]

    def stuck(self) -> list[bool]:
        """Per robot: it has made little of the progress that it demanded."""
        return self._detector.stuck()

    def plan(self, robots: RobotStates, inputs: Sequence[AppliedInput], touching: Sequence[int]) -> Plan:
        """The velocities of one tick, per physics step and robot; iterate to each step when it begins.

        `touching` are the robots that may touch another body in this tick, of those whose drive yields.
        """
        demands = [one.drive for one in inputs]
        if len(self._drives) == 1:
            return self._plan_of(*self._drives[0], robots, demands, touching)
        plans = []
        for indices, drive in self._drives:
            its_robots, its_demands = RobotStates([robots[i] for i in indices]), [demands[i] for i in indices]
            plans.append((indices, iter(self._plan_of(indices, drive, its_robots, its_demands, touching))))
        return self._merged(len(robots), plans)

    def _plan_of(
        self,
        indices: list[int],
        drive: DriveModel,
        robots: RobotStates,
        demands: Sequence[Drive],
        touching: Sequence[int],
    ) -> Plan:
        """The plan of one drive for its robots, which have these indices in the roster."""
        planned = drive.plan(robots, demands, Bodies(self._engine, indices, touching))
        self._detector.update(indices, drive.held_back, robots, drive.possible(demands))
        return planned

    def _merged(
        self, count: int, plans: Sequence[tuple[list[int], Iterator[Sequence[FieldTwist]]]]
    ) -> Iterator[Sequence[FieldTwist]]:
        """Per physics step: the velocities of all robots, of any number of drives."""
        for _ in range(self._steps):
            twists: list[FieldTwist] = [()] * count
            for indices, planned in plans:
                for index, twist in zip(indices, next(planned), strict=True):
                    twists[index] = twist
            yield twists
