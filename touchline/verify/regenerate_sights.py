"""Regenerates the sights of a match that were not recorded: plays it again, with sensors and referee."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from recordings.reading.recorded_config import config_of
from recordings.reading.recording import Recording
from schemas.config.match_config import MatchConfig
from schemas.config.task import with_program
from schemas.errors import TouchlineError
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from sim_host.match.simulation import Simulation
from touchline.verify.repeated_match import RepeatedMatch


@dataclass
class RegeneratedSights:
    """Plays a recorded match again and yields one robot's sights, while the world equals the recorded one."""

    recording: Recording
    robot: str
    commands: Mapping[str, Mapping[int, Command]]
    """Robot → tick of the sight → the robot's command."""
    until: str = field(default="", init=False)
    """Reason why the sights ended before the recording; empty if they did not."""

    def __iter__(self) -> Iterator[Sight]:
        """Yield the sights in order.

        Raises:
            TouchlineError: the recording lacks its match file or its scene, or does not begin at tick 0.
        """
        simulation = Simulation(playable_config(self.recording))
        match = RepeatedMatch(self.recording, simulation, self.commands)
        try:
            for _ in match.ticks():
                if self.robot in simulation.now.sights:
                    yield Sight.decode(simulation.now.sights[self.robot])
        finally:
            simulation.close()
            self.until = match.until


def playable_config(recording: Recording, score_folders: Sequence[Path] = ()) -> MatchConfig:
    """The match file of a recording, from which the match can be played again.

    The program that a recording of a task brings is not run: its score is that of the module in `score_folders`;
    without any it is 0, on which no sight depends.

    Raises:
        TouchlineError: the recording lacks its match file or its scene, or `score_folders` lack the module.
    """
    config = config_of(recording)
    if config is None:
        raise TouchlineError(
            f"{recording.path}: it has neither sights nor its match file; record with touchline match --sights"
        )
    if (task := config.task) is None:
        return config
    program = f"def {task.score.partition(':')[2]}(now): return 0.0"
    if score_folders:
        program = with_program({"task": {"score": task.score}}, str(recording.path), score_folders)["task"]["program"]
    return config.model_copy(update={"task": task.model_copy(update={"program": program})})
