"""Scenes of a few seconds, played in one process by the reference team against robots that stand still."""

from collections.abc import Callable, Iterator

import pytest

from schemas.config.match_config import MatchConfig
from schemas.config.rolling import Rolling
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from sim_host.match.simulation import TickResult
from touchline.play.play_match import InProcessMatch

REFERENCE = "robot_agent.teams.reference:Reference"


class Statue:
    """A robot that stands where it is."""

    def act(self, sight: Sight) -> Command:
        """The answer to one sight."""
        return Command(answers_tick=sight.tick)


class Played:
    """What a scene showed, tick by tick."""

    def __init__(self, match: InProcessMatch) -> None:
        self.match = match
        self.ticks: list[TickResult] = []
        self.commands: list[dict[str, Command]] = []

    def play(self, seconds: float, until: Callable[["Played"], bool] = lambda played: False) -> "Played":
        """Play on for a time, or until a condition holds."""
        end = self.match.simulation.now.time + seconds
        while self.match.simulation.now.time < end and not until(self):
            commands = self.match.answers()
            self.commands.append(commands)
            self.ticks.append(self.match.simulation.step(commands))
        return self

    @property
    def goals(self) -> int:
        """Goals of cyan."""
        return self.match.simulation.state.score.cyan

    def kicks(self, robot: str) -> list[Command]:
        """The commands of a robot with a kick."""
        return [commands[robot] for commands in self.commands if commands[robot].kick is not None]


@pytest.fixture
def scene() -> Iterator[Callable[..., Played]]:
    """Make a scene: robots by name with their pose, the ball, and the phase; names of magenta stand still."""
    matches = []

    def make(
        robots: dict[str, tuple[float, float, float]],
        ball: tuple[float, ...],
        phase: str = "play",
        side: str | None = None,
        **settings: object,
    ) -> Played:
        entries = [
            {"name": name, "side": name.rstrip("0123456789"), "keeper": name.endswith("1")}
            | dict(zip(("x", "y", "heading"), pose, strict=True))
            for name, pose in robots.items()
        ]
        played = {
            "description": "A scene of a test.",
            "game": {"phase": phase, "side": side},
            "ball": dict(zip(("x", "y", "vx", "vy"), ball, strict=False)),
            "robots": entries,
        }
        team = {"name": "Reference", "brain": REFERENCE}
        config = MatchConfig.model_validate(
            {"name": "scene", "seed": 1, "rules": "msl", "scene": played, "teams": {"cyan": team, "magenta": team}}
            | settings
        )
        match = InProcessMatch(config, {name: Statue() for name in robots if name.startswith("magenta")})
        matches.append(match)
        return Played(match)

    yield make
    for match in matches:
        match.close()


@pytest.fixture(scope="session")
def rolling(setup: Setup) -> Rolling:
    """The resistance of the ball."""
    return Rolling.of(setup.ball)
