"""A whole match in one process, without a network: for tests, for learning, and for trying a team out.

Each brain gets a copy of its sight, and its commands cross as the same bytes as on the bus. A match played here and one
played by ten processes in lockstep from the same seed are the same, tick for tick.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from robot_agent.loading.user_code import ReturnedError
from robot_agent.process.robot_code import end_robot, start_robot
from robot_agent.sdk.contract import Brain, Briefing
from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import TeamConfig
from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.command import Command
from schemas.messages.soccer.game import GameEvent, RefereeAction
from schemas.side import Side
from schemas.soccer.game import Score
from sim_host.match.simulation import Simulation, TickResult

BrainSource = Brain | type[Brain] | str
"""A brain, a class to be built with the robot's briefing, or `module:Class`."""


@dataclass(slots=True)
class MatchOutcome:
    """What came of a match."""

    score: Score
    ticks: int
    time: float
    """Simulated time in s."""
    chain: str
    """The hash chain over all states: equal for equal matches."""
    events: list[GameEvent] = field(default_factory=list)


class RobotNotStartedError(TouchlineError):
    """The brain or the program of a robot cannot be started."""

    def __init__(self, robot: str, reason: str) -> None:
        super().__init__(reason)
        self.robot = robot


class InProcessMatch:
    """One match laid out in one process: brains around a simulation, stepped by hand."""

    def __init__(
        self,
        config: MatchConfig,
        brains: Mapping[str, BrainSource] | None = None,
        brain_folder: Path | None = None,
        *,
        chained: bool = True,
    ) -> None:
        """Brains by robot; the others are the match file's, looked for in `brain_folder` first.

        `chained` is that of `sim_host.match.simulation.Simulation`.

        Raises:
            RobotNotStartedError: a brain cannot be loaded.
            TouchlineError: a brain is for a robot that is not in the match.
        """
        self.acting: str | None = None
        """The robot whose brain is built or acts; after an exception, the robot whose brain raised it."""
        self.commands: dict[str, Command] = {}
        """Robot → its newest command; empty before the first."""
        self.simulation = Simulation(config, chained=chained)
        setup = self.simulation.setup()
        self._given = given = brains or {}
        for robot in (robot for side in config.remote_sides for robot in config.robots(side)):
            if robot not in given:
                raise TouchlineError(f"{robot} is of a remote team, which a match in one process lacks; give its brain")
        teams = {name: config.team(side) for side in Side for name in config.robots(side)}
        if unknown := next((name for name in given if name not in teams), None):
            raise TouchlineError(f"{unknown} is no robot with a brain in this match; {did_you_mean(unknown, teams)}")
        self.brains: dict[str, Brain] = {}
        for name, team in teams.items():
            self.acting = name
            try:
                self.brains[name] = _start(given.get(name, team), Briefing.of(name, setup), brain_folder)
            except BaseException as error:
                self.close()
                if not isinstance(error, TouchlineError):
                    raise
                raise RobotNotStartedError(name, str(error)) from error
        self.acting = None

    def close(self) -> None:
        """Free the engine, and end the programs that were started for the match."""
        self.simulation.close()
        for robot, brain in self.brains.items():
            if robot not in self._given:
                end_robot(brain)

    def step(self, actions: tuple[RefereeAction, ...] = ()) -> TickResult:
        """Let every brain answer, then one tick.

        An exception of a brain is raised as it is, with a note that names robot and tick.
        """
        return self.simulation.step(self.answers(), actions)

    def answers(self, robots: Collection[str] | None = None) -> dict[str, Command]:
        """The commands with which the brains answer the newest sights: of these robots, by default of all."""
        commands: dict[str, Command] = {}
        try:
            for name in self.brains if robots is None else robots:
                self.acting = name
                brain, sight = self.brains[name], self.simulation.now.sights.perceived[name]
                command = brain.act(sight.own_copy())
                if not isinstance(command, Command):
                    raise ReturnedError("act", repr(command), brain.act, "return a Command")
                commands[name] = Command.decode(command.encode())
        except BaseException as error:
            error.add_note(f"{self.acting}, tick {self.simulation.now.tick}")
            raise
        self.acting, self.commands = None, commands
        return commands


def play_match(
    config: MatchConfig,
    brains: Mapping[str, BrainSource] | None = None,
    watch: Callable[[TickResult], None] | None = None,
    until: float | None = None,
    brain_folder: Path | None = None,
) -> MatchOutcome:
    """Play a match to its end, or to `until` s of simulated time; `watch` sees each tick.

    Brains are looked for in `brain_folder`, such as the match file's, and then in the current directory.

    Raises:
        TouchlineError: a brain cannot be loaded.
    """
    match = InProcessMatch(config, brains, brain_folder)
    simulation = match.simulation
    events: list[GameEvent] = []
    try:
        while not simulation.over and (until is None or simulation.now.time < until):
            tick = match.step()
            events.extend(tick.events)
            if watch is not None:
                watch(tick)
        now, state = simulation.now, simulation.state
    finally:
        match.close()
    return MatchOutcome(state.score, now.tick, now.time, now.applied["chain"], events)


def _start(source: BrainSource | TeamConfig, briefing: Briefing, brain_folder: Path | None) -> Brain:
    """The brain of a robot, or its running program."""
    if isinstance(source, TeamConfig):
        return start_robot(source.brain or "", source.stdio, briefing, brain_folder)
    if isinstance(source, str):
        return start_robot(source, None, briefing, brain_folder)
    if not isinstance(source, type):
        return source
    build: Callable[[Briefing], Brain] = source
    return build(briefing)
