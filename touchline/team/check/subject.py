"""What is checked: a brain or a program of lines, the match that it is checked for, and its answers."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from robot_agent.loading.brain_error import BrainError
from robot_agent.loading.brain_loader import load_brain
from robot_agent.loading.user_code import place_of
from robot_agent.process.stdio.command_line import command_line
from robot_agent.process.stdio.program import StdioProgram
from robot_agent.sdk.contract import Brain, Briefing
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.side import Side
from schemas.wire.message import BadMessageError
from touchline.matches.engine.hang_watch import HangWatch
from touchline.team.check.bus_program import BusProgram

SIDE = Side.CYAN
"""The side that the checked team plays for."""


class BreachError(Exception):
    """The contract is broken; the text is the sentence that reports how."""

    def __init__(self, sentence: str, raised: str = "") -> None:
        """`raised` is the exception of a brain and its place; empty without one."""
        super().__init__(sentence)
        self.raised = raised


@dataclass(frozen=True, slots=True)
class Subject:
    """What moves the robots of the checked team."""

    config: MatchConfig
    """The match; the checked team plays as cyan."""
    brain: str = ""
    """`module:Class`; empty for a program."""
    stdio: Sequence[str] = ()
    """Command line of a program of lines; empty for a brain."""
    command: Sequence[str] = ()
    """Command line of a program that speaks the protocol; empty for others."""
    folder: Path | None = None
    """Folder in which its module or its files are looked for before the current directory."""
    watch: HangWatch = field(default_factory=lambda: HangWatch(None))
    """Ends the process where a brain does not return; programs have limits of their own."""

    @property
    def robots(self) -> list[str]:
        """The robots of the checked team."""
        return self.config.robots(SIDE)

    def setup(self) -> Setup:
        """The setup of the match."""
        return Setup.of(self.config, self.config.load_profile(), self.config.load_rule_book())

    def start(self, robot: str, setup: Setup) -> "CheckedRobot":
        """A new brain, or a new process of the program, for one robot.

        Raises:
            BreachError: it cannot be built.
        """
        briefing = Briefing.of(robot, setup)
        log: list[str] = []
        try:
            brain = self._brain_of(briefing, log)
        except TouchlineError as error:
            raise BreachError(str(error)) from None
        return CheckedRobot(robot, brain, self.watch, log)

    def _brain_of(self, briefing: Briefing, log: list[str]) -> Brain:
        if self.stdio:
            return StdioProgram(command_line(self.stdio, self.folder), briefing, log=log.append)
        if self.command:
            return BusProgram(command_line(self.command), briefing, log)
        with self.watch.acting(f"{briefing.robot}: building {self.brain}", is_built=False):
            return load_brain(self.brain, briefing, self.folder)


@dataclass(slots=True)
class CheckedRobot:
    """One brain or program, whose every answer is examined."""

    robot: str
    brain: Brain
    watch: HangWatch
    log: list[str] = field(default_factory=list)
    """What a program did wrong, line by line."""

    def act(self, sight: Sight) -> Command:
        """Its command for a sight.

        Raises:
            BreachError: it raises, or what it returns is no valid command for that sight.
        """
        try:
            command = self._answer(sight)
        except BreachError:
            raise
        except TouchlineError as error:
            raise BreachError(str(error)) from None
        except (Exception, SystemExit) as error:
            failure = BrainError(sight.tick, self.brain.act)
            failure.__cause__ = error
            raised = f"{type(error).__name__}{place_of(error)}"
            raise BreachError(f"{self.robot}: {failure.report().splitlines()[-1]}", raised) from None
        if not isinstance(command, Command):
            raise BreachError(f"{self.robot}: {BrainError(sight.tick, self.brain.act, command).report().strip()}")
        if self.log:
            raise BreachError(self.log[0])
        if command.answers_tick != sight.tick:
            raise BreachError(
                f"{self.robot}: answers_tick is {command.answers_tick} for the sight of tick {sight.tick}; "
                "return Command(answers_tick=sight.tick, …)"
            )
        try:
            return Command.decode(command.encode())
        except BadMessageError as error:
            raise BreachError(f"{self.robot}: {error}") from None

    def _answer(self, sight: Sight) -> object:
        with self.watch.acting(f"{self.robot}: act at tick {sight.tick}"):
            return self.brain.act(sight)

    def close(self) -> None:
        """End the program, if it is one."""
        if isinstance(self.brain, StdioProgram | BusProgram):
            self.brain.close()
