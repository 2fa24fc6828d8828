"""What a brain is, and its briefing before the match."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from schemas.config.match_parts import Parameter
from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.side import Side


class Brain(Protocol):
    """Controls one robot. Everything in and out is in the team frame, which attacks +x."""

    def act(self, sight: Sight) -> Command:
        """The command for one sight; called once for each tick, in order."""


@dataclass(frozen=True, slots=True)
class Briefing:
    """What a brain knows before its first sight."""

    robot: str
    side: Side
    number: int
    """Place in the team's list, from 1; 1 is the goalkeeper, in a team that has one."""
    teammates: tuple[str, ...]
    """The others of the team, in the order of the list."""
    setup: Setup
    """The match, with the numbers of this robot's own model: body, drive, dribbler, kicker."""
    parameters: Mapping[str, Parameter] = field(default_factory=dict)
    """Values that the match file gives the team in `[teams.cyan.parameters]`; empty without any."""

    @classmethod
    def of(cls, robot: str, setup: Setup) -> "Briefing":
        """The briefing of one robot of a match.

        Raises:
            TouchlineError: no robot of that name is in the match.
        """
        for side, team in setup.teams.items():
            if robot in team.robots:
                mates = tuple(name for name in team.robots if name != robot)
                number, own = team.robots.index(robot) + 1, setup.for_robot(robot)
                return cls(robot, side, number, mates, own, team.parameters)
        known = did_you_mean(robot, setup.sides)
        raise TouchlineError(f'robot is "{robot}", which is not in match "{setup.match}"; {known}')
