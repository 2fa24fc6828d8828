"""Who is who in a match, for the channels of its recording: side, team and type of a robot."""

from schemas.config.profile import STANDARD
from schemas.config.roster import RosterEntry
from schemas.messages.host import Setup
from schemas.side import Side


class RosterMetadata:
    """Robots and teams as the host's setup names them, and as the roster has changed since."""

    def __init__(self, setup: Setup | None = None) -> None:
        self._teams: dict[str, str] = {}
        self._robots: dict[str, tuple[str, str]] = {}
        if setup is None:
            return
        for side, team in setup.teams.items():
            self._teams[side.value] = team.name
            for robot in team.robots:
                self._robots[robot] = side.value, team.types.get(robot, STANDARD)

    def update(self, robots: list[RosterEntry]) -> None:
        """Others take part; who left is remembered, as what it said is still in the file."""
        for robot in robots:
            self._robots[robot.name] = robot.side.value, robot.type

    def metadata_of(self, chunks: dict[str, str]) -> dict[str, str]:
        """What is known of the robot or the side that a key names: `side`, `team`, and `model`, the robot's type."""
        metadata = dict(chunks)
        side, model = self._robots.get(chunks.get("robot", ""), (chunks.get("side"), None))
        if side is not None and side in [known.value for known in Side]:
            metadata["side"] = side
        if side in self._teams:
            metadata["team"] = self._teams[side]
        if model is not None:
            metadata["model"] = model
        return metadata
