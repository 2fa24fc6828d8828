"""The robots of a match as its setup names them, and as the roster has changed since."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Self

from schemas.config.profile import STANDARD
from schemas.config.roster import RosterEntry, goalkeeper_of
from schemas.messages.setup import Setup
from schemas.side import Side


@dataclass(frozen=True, slots=True)
class Lineup:
    """Robots by name, in the order of the roster; robots that have left keep their side and type."""

    robots: dict[str, RosterEntry]

    @classmethod
    def of(cls, setup: Setup | None) -> Self:
        """The robots that a match begins with; a team's first robot is its goalkeeper, unless it plays without."""
        return cls(
            {
                name: RosterEntry(
                    name=name,
                    side=side,
                    type=team.types.get(name, STANDARD),
                    keeper=team.goalkeeper and name == team.robots[0],
                )
                for side, team in (setup.teams if setup is not None else {}).items()
                for name in team.robots
            }
        )

    def changed(self, roster: Sequence[RosterEntry]) -> "Lineup":
        """The lineup when these robots, and no others, take part."""
        before = {name: robot.model_copy(update={"keeper": False}) for name, robot in self.robots.items()}
        return Lineup(before | {robot.name: robot for robot in roster})

    @property
    def sides(self) -> dict[str, Side]:
        """Robot → its side."""
        return {name: robot.side for name, robot in self.robots.items()}

    def side(self, robot: str) -> Side | None:
        """The side that a robot plays for; None for a robot that never took part."""
        entry = self.robots.get(robot)
        return entry.side if entry is not None else None

    def is_keeper(self, robot: str) -> bool:
        """Whether a robot is its side's goalkeeper."""
        entry = self.robots.get(robot)
        return entry is not None and entry.keeper

    def keeps(self, robot: str, on_field: Collection[str]) -> bool:
        """Whether a robot keeps its side's goal while these robots are on the field."""
        side = self.side(robot)
        team = [entry for entry in self.robots.values() if entry.side is side]
        team.sort(key=lambda entry: not entry.keeper)
        if not team or not team[0].keeper:
            return False
        return goalkeeper_of([one.name for one in team], {one.name for one in team} - set(on_field)) == robot
