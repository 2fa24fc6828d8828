"""How much of the radio the robots and teams of a match have used."""

from collections import defaultdict
from collections.abc import Mapping
from typing import NamedTuple

from schemas.side import Side
from sim_host.match.radio_medium import Budget


class RobotRadio(NamedTuple):
    """The radio messages of one robot since the match began."""

    bytes: int = 0
    """Bytes of the messages that were sent."""
    refused: int = 0
    """Messages that were refused."""


NO_RADIO = RobotRadio()


class RadioUse:
    """Counts that outlast the roster and the episode."""

    def __init__(self) -> None:
        self.bits: defaultdict[str, int] = defaultdict(int)
        """Robot → bits sent since the match began."""
        self.refused: defaultdict[str, int] = defaultdict(int)
        """Robot → messages refused since the match began."""
        self._budgets: Mapping[Side, Budget] = {side: Budget() for side in Side}
        self._before = dict.fromkeys(Side, 0)
        """Side → bits in the busiest second of earlier budgets."""

    def follow(self, budgets: Mapping[Side, Budget]) -> None:
        """Count what is spent of these budgets from now on, apart from what was spent of others."""
        self._before = {side: self.busiest(side) for side in Side}
        self._budgets = budgets

    def busiest(self, side: Side) -> int:
        """Bits that a team has sent in its busiest second."""
        return max(self._before[side], self._budgets[side].busiest)

    def of_robot(self, robot: str) -> RobotRadio:
        """What one robot has used."""
        return RobotRadio(self.bits.get(robot, 0) // 8, self.refused.get(robot, 0))
