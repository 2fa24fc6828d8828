"""A brain against a recording: it is shown what a robot saw, and what it says is compared with what the robot said."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from recordings.reading.recording import Recording
from robot_agent.contract import Brain, Briefing, load_brain
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.topics import COMMAND, SIGHT

if TYPE_CHECKING:
    from touchline.verify.regenerate_sights import RegeneratedSights


@dataclass(frozen=True, slots=True)
class FirstDifference:
    """Where a brain says something else for the first time."""

    tick: int
    time: float
    """Simulated s."""
    field: str
    recorded: Any
    answered: Any


@dataclass(frozen=True, slots=True)
class BrainComparison:
    """What came of it."""

    robot: str
    brain: str
    sights: str
    """`recorded`, or `simulated` where the match was simulated again for them."""
    compared: int
    """Sights that the robot had answered, and the brain was shown."""
    different: int
    fields: dict[str, int]
    """Field of a command → how often it differs."""
    first: FirstDifference | None
    until: str
    """Why sights ended before the recording did; nothing when they did not."""

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return asdict(self)

    def sentence(self) -> str:
        """One line."""
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
    """Robot → tick of the sight → what it answered; of two answers to one sight the first, which the host took."""
    commands: dict[str, dict[int, Command]] = {}
    for recorded, command in recording.decoded(COMMAND.fill()):
        commands.setdefault(recorded.key.split("/")[1], {}).setdefault(command.answers_tick, command)
    return commands


def compare_brain(recording: Recording, robot: str, spec: str) -> BrainComparison:
    """Show a brain every sight that the robot answered, in order, and compare.

    Raises:
        TouchlineError: no such robot or brain, or a recording that sights cannot be had from.
        MatchFailedError: the brain raised.
    """
    setup = recording.manifest.setup
    if setup is None:
        raise TouchlineError(f"{recording.path}: the recording does not say how its match was set up")
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
            continue  # the robot never saw it, or it was sent again
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
    """Every field that differs: its name, what was recorded, what is commands."""
    if isinstance(recorded, dict) and isinstance(answered, dict):
        for name in {**recorded, **answered}:
            yield from _differences(recorded.get(name), answered.get(name), f"{path}.{name}".lstrip("."))
    elif recorded != answered:
        yield path, recorded, answered
