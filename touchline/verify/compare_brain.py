"""Compares a brain with a recording: feeds it a robot's sights and compares its commands with the recorded ones."""

import math
import sys
from bdb import BdbQuit
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path
from typing import Any

from recordings.reading.recording import Recording
from robot_agent.loading.brain_loader import load_brain
from robot_agent.loading.user_code import place_of, sentence_of
from robot_agent.sdk.contract import Brain, Briefing
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.topics import SIGHT
from touchline.verify.command_difference import FieldDifference, differences
from touchline.verify.repeated_match import commands_of

Act = Callable[[Brain, Sight], Command]
"""A way to call a brain."""
EPSILON_S = 1e-6
"""Far below a tick: simulated times are products of ticks, and are typed with few decimals."""


def plainly(brain: Brain, sight: Sight) -> Command:
    """Call a brain as a robot's process does."""
    return brain.act(sight)


@dataclass(frozen=True, slots=True)
class FirstDifference:
    """The first command of a brain that differs from the recorded one."""

    tick: int
    time: float
    """Simulated time, s."""
    field: str
    recorded: Any
    answered: Any


@dataclass(slots=True)
class BrainComparison:
    """The result of the comparison, which is counted while it goes on."""

    robot: str
    brain: str
    sights: str
    """Source of the sights: `recorded`, or `simulated` if the match was simulated again."""
    earlier: int = 0
    """Number of sights before the compared ones, which the brain received for its state."""
    compared: int = 0
    """Number of sights that the robot answered and the brain received, up to the end of the comparison."""
    different: int = 0
    fields: dict[str, int] = field(default_factory=dict)
    """Field of a command → number of differences."""
    first: FirstDifference | None = None
    until: str = ""
    """Reason why the sights ended before the recording; empty if they did not."""

    def add(self, sight: Sight, found: list[FieldDifference]) -> None:
        """Count a command that was compared, with the fields in which it differs."""
        self.compared += 1
        self.different += bool(found)
        for name, before, now in found:
            self.fields[name] = self.fields.get(name, 0) + 1
            self.first = self.first or FirstDifference(sight.tick, sight.time, name, before, now)

    def sentence(self) -> str:
        """The verdict as one line."""
        extent = f"{self.compared} commands of {self.robot} ({self.sights} sights" + (
            f", until {self.until})" if self.until else ")"
        )
        if self.first is None:
            return f"identical: {self.brain} gives all {extent} as recorded"
        first, equal = self.first, self.compared - self.different
        often = ", ".join(f"{name} {count}" for name, count in self.fields.items()) if self.different > 1 else ""
        return (
            f"{self.brain}: {equal} of {extent} equal; first difference at tick {first.tick} ({first.time:.2f} s)"
            f"{'; ' if often else ''}{often}"
        )


@dataclass(frozen=True, slots=True)
class ComparisonSettings:
    """What is compared, and how the brain is called."""

    start: float = 0.0
    """Simulated time of the first sight, in s; the brain receives earlier ones for its state, without its output."""
    end: float = math.inf
    """Simulated time of the last sight, in s."""
    first_only: bool = False
    """End with the first difference."""
    act: Act = plainly
    """Calls the brain with a sight that is compared."""
    show: Callable[[Sight, list[FieldDifference]], None] = lambda _sight, _found: None
    """Receives each command that differs."""
    brain_folder: Path | None = None
    """Folder in which the brain's module is looked for before the current directory."""


def compare_brain(
    recording: Recording, robot: str, spec: str, settings: ComparisonSettings | None = None
) -> BrainComparison:
    """Feed a new brain the sights that the robot answered, in order, and compare the commands.

    Raises:
        TouchlineError: the robot or brain does not exist, or the recording cannot provide sights.
        MatchFailedError: the brain raised.
    """
    setup = recording.setup
    settings = settings or ComparisonSettings()
    brain = load_brain(spec, Briefing.of(robot, setup), settings.brain_folder)
    commands = commands_of(recording)
    if not commands.get(robot):
        raise TouchlineError(f"{recording.path}: no commands of {robot} are recorded; name a robot that played")
    key = SIGHT.fill(robot=robot)
    if any(channel.key == key and channel.messages for channel in recording.channels):
        comparison = BrainComparison(robot, spec, "recorded")
        _compare(brain, (sight for _, sight in recording.decoded(key)), commands[robot], settings, comparison)
        return comparison
    from touchline.verify.regenerate_sights import RegeneratedSights  # needs PyBullet, unlike recorded sights

    comparison, sights = BrainComparison(robot, spec, "simulated"), RegeneratedSights(recording, robot, commands)
    _compare(brain, sights, commands[robot], settings, comparison)
    comparison.until = sights.until
    return comparison


def _compare(
    brain: Brain,
    sights: Iterable[Sight],
    commands: Mapping[int, Command],
    settings: ComparisonSettings,
    comparison: BrainComparison,
) -> None:
    answered, spec = -1, comparison.brain
    for sight in sights:
        recorded = commands.get(sight.tick)
        if recorded is None or sight.tick <= answered:
            continue  # the robot did not answer it, or it was sent twice
        if sight.time > settings.end + EPSILON_S:
            break
        answered = sight.tick
        if sight.time < settings.start - EPSILON_S:
            with without_output():
                checked_answer(spec, brain, sight)
            comparison.earlier += 1
            continue
        found = differences(recorded, checked_answer(spec, brain, sight, settings.act))
        comparison.add(sight, found)
        if found:
            settings.show(sight, found)
            if settings.first_only:
                break


@contextmanager
def without_output() -> Iterator[None]:
    """Discard what a brain prints, and skip its breakpoints."""
    hook = sys.breakpointhook
    sys.breakpointhook = lambda *_, **__: None
    try:
        with redirect_stdout(StringIO()):
            yield
    finally:
        sys.breakpointhook = hook


def checked_answer(spec: str, brain: Brain, sight: Sight, act: Act = plainly) -> Command:
    """The brain's command as the host would receive it.

    Raises:
        MatchFailedError: the brain raised, or returned no command.
        BdbQuit: the user has quit a debugger in the brain.
    """
    try:
        command = act(brain, sight)
    except BdbQuit:
        raise
    except (Exception, SystemExit) as error:
        raise MatchFailedError(f"{spec} raised at tick {sight.tick}: {sentence_of(error)}{place_of(error)}") from error
    if not isinstance(command, Command):
        raise MatchFailedError(f"{spec} returned {command!r} at tick {sight.tick}; return a Command")
    return Command.decode(command.encode())
