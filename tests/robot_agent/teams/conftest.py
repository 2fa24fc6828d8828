"""A team on the pitch: everyone's brain, everyone's sight, and the radio between them."""

import math
from collections.abc import Callable

import pytest
from msgspec.structs import replace

from robot_agent.loading.brain_loader import load_brain
from robot_agent.sdk.contract import Briefing
from schemas.messages.command import Command
from schemas.messages.radio import Motion
from schemas.messages.setup import Setup
from schemas.messages.sight import ReceivedRadio, Sight
from schemas.side import Side

BRAINS = {
    "simple": "robot_agent.teams.simple:Simple",
    "nubot": "robot_agent.teams.nubot:NuBot",
    "random": "robot_agent.teams.random:Random",
}


class Squad:
    """One team's brains at fixed or moved poses, with perfect sight; each radio message arrives a tick later."""

    def __init__(self, team: str, setup: Setup, sight_of: Callable[..., Sight], poses: dict[str, tuple[float, ...]]):
        self.setup = setup
        self.poses = dict(poses)
        self.sight_of = sight_of
        self.tick = 0
        self.said: dict[str, ReceivedRadio] = {}
        self.brains = {name: load_brain(BRAINS[team], Briefing.of(name, setup)) for name in poses}

    def meet(self) -> None:
        """Deliver the radio messages of all robots to all."""
        for name, (x, y, heading) in self.poses.items():
            self.said[name] = ReceivedRadio(age=0.0, self=Motion(x=x, y=y, heading=heading))

    def act(self, **seen: object) -> dict[str, Command]:
        """One tick: the commands of all robots."""
        commands = {name: brain.act(self.sight(name, **seen)) for name, brain in self.brains.items()}
        for name, heard in self.said.items():
            self.said[name] = replace(heard, age=heard.age + 0.02)
        for name, command in commands.items():
            if command.radio is not None:
                self.said[name] = ReceivedRadio.of(command.radio)
        self.tick += 1
        return commands

    def sight(self, name: str, **seen: object) -> Sight:
        """The sight of one robot: its teammates as obstacles, and their radio messages."""
        others = {other: pose for other, pose in self.poses.items() if other != name}
        obstacles = tuple((x, y) for x, y, _ in others.values()) + tuple(seen.pop("opponents", ()))
        radio = {other: word for other, word in self.said.items() if other != name}
        return self.sight_of(self.tick, name, self.poses[name], obstacles=obstacles, radio=radio, **seen)

    def move(self, commands: dict[str, Command]) -> None:
        """All robots drive exactly as demanded for one tick."""
        for name, command in commands.items():
            x, y, heading = self.poses[name]
            c, s, drive = math.cos(heading), math.sin(heading), command.drive
            dt = self.setup.time.tick
            self.poses[name] = (
                x + (c * drive.vx - s * drive.vy) * dt,
                y + (s * drive.vx + c * drive.vy) * dt,
                heading + drive.omega * dt,
            )


STARTS = {1: (-10.5, 0.0, 0.0), 2: (-2.0, 1.0, 0.0), 3: (-2.0, -1.0, 0.0), 4: (-5.0, 2.0, 0.0), 5: (-5.0, -2.0, 0.0)}


@pytest.fixture
def squad(setup, sight_of):
    def make(
        team: str = "simple",
        poses: dict[int, tuple[float, float, float]] | None = None,
        side: Side = Side.CYAN,
        setup: Setup = setup,
    ) -> Squad:
        numbered = poses or STARTS
        made = Squad(team, setup, sight_of, {f"{side.value}{number}": pose for number, pose in numbered.items()})
        made.meet()
        return made

    return make
