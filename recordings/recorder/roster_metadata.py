"""The lineup of a match as metadata for the channels of its recording: side, team and type of a robot."""

from recordings.container.lineup import Lineup
from schemas.config.roster import RosterEntry
from schemas.messages.setup import Setup


class RosterMetadata:
    """Follows the roster of a match."""

    def __init__(self, setup: Setup | None = None, lineup: Lineup | None = None) -> None:
        """The robots are those that the match begins with, unless a `lineup` is given."""
        self._lineup = lineup or Lineup.of(setup)
        self._teams = {side.value: team.name for side, team in setup.teams.items()} if setup is not None else {}

    @property
    def robots(self) -> list[str]:
        """The names of all robots that take part or did, in the order of the roster."""
        return list(self._lineup.robots)

    def update(self, roster: list[RosterEntry]) -> None:
        """Replace the roster. Robots that have left are kept, because the file has messages of them."""
        self._lineup = self._lineup.changed(roster)

    def metadata_of(self, chunks: dict[str, str]) -> dict[str, str]:
        """Metadata on the robot or the side in a key: `side`, `team`, and `model`, the robot's type."""
        robot = self._lineup.robots.get(chunks.get("robot", ""))
        side = robot.side.value if robot is not None else chunks.get("side")
        metadata = dict(chunks)
        if side is not None:
            metadata["side"] = side
        if side in self._teams:
            metadata["team"] = self._teams[side]
        if robot is not None:
            metadata["model"] = robot.type
        return metadata
