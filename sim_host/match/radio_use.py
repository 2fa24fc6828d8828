"""How much of the radio the robots and teams of a match have used."""

from dataclasses import dataclass, field
from typing import NamedTuple

from schemas.side import Side


class RobotRadio(NamedTuple):
    """The radio messages of one robot since the match began."""

    bytes: int = 0
    """Bytes of the messages that were sent."""
    refused: int = 0
    """Messages that were refused."""


NO_RADIO = RobotRadio()


@dataclass(slots=True)
class RadioUse:
    """Counts that outlast the roster and the episode."""

    bits: dict[str, int] = field(default_factory=dict)
    """Robot → bits sent since the match began."""
    refused: dict[str, int] = field(default_factory=dict)
    """Robot → messages refused since the match began."""
    busiest: dict[Side, int] = field(default_factory=lambda: dict.fromkeys(Side, 0))
    """Side → bits sent in its busiest second."""

    def add_sent(self, robot: str, side: Side, bits: int, second: int) -> None:
        """Count a message of `bits`; `second` has the team's bits of the last second, with this message."""
        self.bits[robot] = self.bits.get(robot, 0) + bits
        if second > self.busiest[side]:
            self.busiest[side] = second

    def add_refused(self, robot: str) -> None:
        """Count a message that was refused."""
        self.refused[robot] = self.refused.get(robot, 0) + 1

    def of_robot(self, robot: str) -> RobotRadio:
        """What one robot has used."""
        return RobotRadio(self.bits.get(robot, 0) // 8, self.refused.get(robot, 0))
