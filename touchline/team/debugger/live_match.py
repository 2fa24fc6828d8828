"""A recorded match that goes on live from one tick: with another brain for one robot, and in its exact state."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from recordings.reading.recording import Recording
from robot_agent.loading.brain_loader import load_brain
from robot_agent.process.robot_code import end_robot, start_robot
from robot_agent.sdk.contract import Brain, Briefing
from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import TeamConfig
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.side import Side
from sim_host.match.simulation import TickResult
from touchline.play.match_recording import MatchRecording
from touchline.play.play_match import InProcessMatch
from touchline.verify.command_difference import differences
from touchline.verify.compare_brain import EPSILON_S, Act, checked_answer, plainly, without_output
from touchline.verify.regenerate_sights import playable_config
from touchline.verify.repeated_match import Observe, RepeatedMatch, commands_of


class RecordedRobot:
    """A robot that repeats its recorded commands, with their radio messages; it rests where none is recorded."""

    def __init__(self, commands: Mapping[int, Command]) -> None:
        """`commands` are by the tick of their sight."""
        self._commands = commands

    def act(self, sight: Sight) -> Command:
        """The recorded command for the sight of this tick."""
        return self._commands.get(sight.tick) or Command(answers_tick=sight.tick)


class CheckedBrain:
    """A brain whose failures name it, called by the debugger or without output."""

    def __init__(self, spec: str, brain: Brain, act: Act) -> None:
        self.spec = spec
        self.brain = brain
        self._act = act

    def act(self, sight: Sight) -> Command:
        """The brain's command.

        Raises:
            MatchFailedError: the brain raised, or returned no command.
        """
        return checked_answer(self.spec, self.brain, sight, self._act)


def quietly(brain: Brain, sight: Sight) -> Command:
    """Call a brain that is not the one under examination."""
    with without_output():
        return brain.act(sight)


@dataclass(slots=True)
class LiveResult:
    """What came of the match."""

    start: float
    """Simulated time in s from which it was live."""
    end: float
    state: GameState
    """The game at the end."""
    events: list[GameEvent] = field(default_factory=list)


class LiveMatch:
    """A recorded match up to one tick, and from there on with live brains."""

    def __init__(
        self,
        recording: Recording,
        robot: str,
        spec: str,
        act: Act = plainly,
        brain_folder: Path | None = None,
        out: Path | None = None,
    ) -> None:
        """`act` calls the brain of `robot` once the match is live.

        `brain_folder` is where brains are looked for before the current directory. `out` gets a recording of all.

        The other robots are played by the brains of the match file, or else by their recorded commands.

        Raises:
            TouchlineError: the recording lacks its match file, or robot or brain do not exist.
        """
        folders = [*([brain_folder] if brain_folder is not None else []), Path.cwd()]
        config, setup = playable_config(recording, folders), recording.setup
        self.notes: list[str] = []
        """What does not go on as in the recorded match, for the user."""
        self._robot = robot
        self._differing: set[str] = set()
        self._programs: list[Brain] = []
        self._commands = commands_of(recording)
        self._brain_folder = brain_folder
        examined = load_brain(spec, Briefing.of(robot, setup), brain_folder)
        brains: dict[str, Brain] = {robot: CheckedBrain(spec, examined, act)}
        for side in Side:
            names = [name for name in config.robots(side) if name != robot]
            brains |= self._others(config, side, names, setup)
        self._match = InProcessMatch(config, brains)
        simulation = self._match.simulation
        self._recording = MatchRecording(out, config, simulation) if out is not None else None
        self._observe: Observe = self._recording.add if self._recording is not None else lambda _tick, _commands: None
        self._repeated = RepeatedMatch(recording, simulation, self._commands, self._observe)

    def close(self) -> None:
        """Finish the recording, free the engine, and end the programs that play."""
        if self._recording is not None:
            self._recording.close()
        self._match.close()
        for program in self._programs:
            end_robot(program)

    def play(self, start: float, end: float, watch: Callable[[TickResult], None]) -> LiveResult:
        """Repeat the recorded match up to `start`, then play on to `end` or full time; times are simulated, in s.

        `watch` sees each live tick.

        Raises:
            TouchlineError: the match cannot be repeated up to `start`.
            MatchFailedError: a brain failed.
        """
        simulation = self._match.simulation
        self._repeat(start)
        began = simulation.now.time
        result = LiveResult(began, began, simulation.state.game_state(simulation.now.tick, began))
        while not simulation.over and simulation.now.time < end - EPSILON_S:
            commands = self._match.answers()
            tick = simulation.step(commands)
            self._observe(tick, commands)
            result.events.extend(tick.events)
            watch(tick)
        result.end = simulation.now.time
        result.state = simulation.state.game_state(simulation.now.tick, result.end)
        return result

    def _others(self, config: MatchConfig, side: Side, names: list[str], setup: Setup) -> dict[str, Brain]:
        """The other robots of a side: with the brains of the match file, or with their recorded commands."""
        team = config.team(side)
        spec = team.brain or " ".join(team.stdio or [])
        try:
            if not spec:
                raise TouchlineError("their program needs a match on the bus")
            built = {name: self._started(team, Briefing.of(name, setup)) for name in names}
        except TouchlineError as error:
            self.notes += [f"{', '.join(names)}: recorded commands; {error}"] if names else []
            return {name: self._recorded(name) for name in names}
        return {name: CheckedBrain(spec, brain, quietly) for name, brain in built.items()}

    def _started(self, team: TeamConfig, briefing: Briefing) -> Brain:
        robot = start_robot(team.brain or "", team.stdio, briefing, self._brain_folder)
        if team.stdio:
            self._programs.append(robot)
        return robot

    def _recorded(self, robot: str) -> RecordedRobot:
        return RecordedRobot(self._commands.get(robot, {}))

    def _repeat(self, start: float) -> None:
        """Repeat the recorded match up to the sights of `start`; the brains receive earlier ones for their state."""
        simulation, brains = self._match.simulation, self._match.brains
        for tick in self._repeated.ticks():
            if simulation.now.time >= start - EPSILON_S:
                return
            for name in brains:
                recorded = self._commands.get(name, {}).get(tick)
                if recorded is not None and name in simulation.now.sights:
                    self._give(name, Sight.decode(simulation.now.sights[name]), recorded)
        why = self._repeated.until or f"its last tick is at {simulation.now.time:.2f} s"
        raise TouchlineError(f"the match cannot be repeated up to {start:.2f} s: {why}; begin earlier")

    def _give(self, robot: str, sight: Sight, recorded: Command) -> None:
        """Give a sight to a brain. One of the match file that fails here is replaced by its recorded commands."""
        brains = self._match.brains
        brain = brains[robot]
        if isinstance(brain, RecordedRobot):
            return
        try:
            with without_output():
                answer = brain.act(sight)
        except MatchFailedError as error:
            if robot == self._robot:
                raise
            brains[robot] = self._recorded(robot)
            self.notes.append(f"{robot}: recorded commands; {error}")
            return
        if robot != self._robot and robot not in self._differing and differences(recorded, answer):
            self._differing.add(robot)
            self.notes.append(f"{robot}: its brain differs from the recorded commands from tick {sight.tick} on")
