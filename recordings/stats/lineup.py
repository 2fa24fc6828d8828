"""Who plays on which side, and who keeps the goal; another lineup when robots come or go."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import Self

from schemas.config.goalkeeper import goalkeeper_of
from schemas.config.roster import RosterEntry
from schemas.messages.host import Setup
from schemas.side import Side


@dataclass(frozen=True, slots=True)
class Lineup:
    """Robots by name, in the order of the roster."""

    sides: dict[str, Side]
    keepers: dict[Side, str] = field(default_factory=dict)

    @classmethod
    def of(cls, setup: Setup) -> Self:
        """The robots that a match begins with; a side's first robot is its goalkeeper, unless it plays without."""
        return cls(
            sides={name: side for side, team in setup.teams.items() for name in team.robots},
            keepers={side: team.robots[0] for side, team in setup.teams.items() if team.robots and team.goalkeeper},
        )

    def changed(self, robots: Sequence[RosterEntry]) -> "Lineup":
        """The lineup when these robots are the ones that take part; who left is still known by its side."""
        return Lineup(
            sides=self.sides | {entry.name: entry.side for entry in robots},
            keepers={entry.side: entry.name for entry in robots if entry.keeper},
        )

    def keeps(self, robot: str, there: Collection[str]) -> bool:
        """Whether a robot keeps its side's goal while these robots are on the field."""
        side = self.sides.get(robot)
        if side is None or side not in self.keepers:
            return False
        mine = [self.keepers[side], *(name for name, its in self.sides.items() if its is side)]
        return goalkeeper_of(mine, [name for name in mine if name not in there]) == robot

    def is_keeper(self, robot: str) -> bool:
        """Whether a robot is its side's goalkeeper."""
        return robot in self.keepers.values()
