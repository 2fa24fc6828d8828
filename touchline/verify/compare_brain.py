"""Compares a brain with a recording: feeds it a robot's sights and compares its commands with the recorded ones."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from recordings.reading.recording import Recording
from robot_agent.brain_loader import load_brain
from robot_agent.contract import Brain, Briefing
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.topics import COMMAND, SIGHT

if TYPE_CHECKING:
    from touchline.verify.regenerate_sights import RegeneratedSights


@dataclass(frozen=True, slots=True)
class FirstDifference:
    """The first command of a brain that differs from the recorded one."""

    tick: int
    time: float
    """Simulated time, s."""
    field: str
    recorded: Any
    answered: Any


@dataclass(frozen=True, slots=True)
class BrainComparison:
    """The result of the comparison."""

    robot: str
    brain: str
    sights: str
    """Source of the sights: `recorded`, or `simulated` if the match was simulated again."""
    compared: int
    """Number of sights that the robot answered and the brain received."""
    different: int
    fields: dict[str, int]
    """Field of a command → number of differences."""
    first: FirstDifference | None
    until: str
    """Reason why the sights ended before the recording; empty if they did not."""

    def to_json(self) -> dict[str, Any]:
        """The verdict as plain JSON values."""
        return asdict(self)

    def sentence(self) -> str:
        """The verdict as one line."""
        extent = f"{self.compared} {self.sights} sights of {self.robot}" + (
            f", until {self.until}" if self.until else ""
        )
        if self.first is None:
            return f"identical: {self.brain} answers {extent} as recorded"
        first = self.first
        often = ", ".join(f"{name} {count}" for name, count in self.fields.items())
        return (
            f"{self.brain} differs in {self.different} of {extent}; first at tick {first.tick} ({first.time:.2f} s): "
            f"{first.field} is {first.answered!r}, recorded {first.recorded!r}; {often}"
        )


def commands_of(recording: Recording) -> dict[str, dict[int, Command]]:
    """Robot → tick of the sight → the robot's command; of two for one sight the first, which the host applied."""
    commands: dict[str, dict[int, Command]] = {}
    for recorded, command in recording.decoded(COMMAND.fill()):
        commands.setdefault(recorded.key.split("/")[1], {}).setdefault(command.answers_tick, command)
    return commands


def compare_brain(recording: Recording, robot: str, spec: str) -> BrainComparison:
    """Feed a brain every sight that the robot answered, in order, and compare the commands.

    Raises:
        TouchlineError: the robot or brain does not exist, or the recording cannot provide sights.
        MatchFailedError: the brain raised.
    """
    setup = recording.manifest.setup
    if setup is None:
        raise TouchlineError(f"{recording.path}: the recording lacks the setup of its match")
    brain = load_brain(spec, Briefing.of(robot, setup))
    commands = commands_of(recording)
    if not commands.get(robot):
        raise TouchlineError(f"{recording.path}: no commands of {robot} are recorded; name a robot that played")
    key = SIGHT.fill(robot=robot)
    if any(channel.key == key and channel.messages for channel in recording.channels):
        recorded = (sight for _, sight in recording.decoded(key))
        return _compared(brain, spec, robot, recorded, "recorded", commands[robot], None)
    from touchline.verify.regenerate_sights import RegeneratedSights  # needs PyBullet, which recorded sights do not

    regenerated = RegeneratedSights(recording, robot, commands)
    return _compared(brain, spec, robot, regenerated, "simulated", commands[robot], regenerated)


def _compared(
    brain: Brain,
    spec: str,
    robot: str,
    sights: Iterable[Sight],
    origin: str,
    commands: Mapping[int, Command],
    regenerated: "RegeneratedSights | None",
) -> BrainComparison:
    compared = different = 0
    first: FirstDifference | None = None
    fields: dict[str, int] = {}
    shown = -1
    for sight in sights:
        recorded = commands.get(sight.tick)
        if recorded is None or sight.tick <= shown:
            continue  # the robot did not answer it, or it was sent twice
        shown, compared = sight.tick, compared + 1
        differences = list(_differences(recorded.plain(), _answer(brain, spec, sight).plain()))
        different += bool(differences)
        for name, before, now in differences:
            fields[name] = fields.get(name, 0) + 1
            first = first or FirstDifference(sight.tick, sight.time, name, before, now)
    return BrainComparison(
        robot, spec, origin, compared, different, fields, first, regenerated.until if regenerated is not None else ""
    )


def _answer(brain: Brain, spec: str, sight: Sight) -> Command:
    try:
        command = brain.act(sight)
    except Exception as error:
        what = f"{type(error).__name__}: {' '.join(str(error).split())}"
        raise MatchFailedError(f"{spec} raised at tick {sight.tick}: {what}") from error
    if not isinstance(command, Command):
        raise MatchFailedError(f"{spec} returned {command!r} at tick {sight.tick}; return a Command")
    return Command.decode(command.encode())


def _differences(recorded: Any, answered: Any, path: str = "") -> Iterator[tuple[str, Any, Any]]:
    """Every field that differs: its name, the recorded value, the value of the brain."""
    if isinstance(recorded, dict) and isinstance(answered, dict):
        for name in {**recorded, **answered}:
            yield from _differences(recorded.get(name), answered.get(name), f"{path}.{name}".lstrip("."))
    elif recorded != answered:
        yield path, recorded, answered
