"""The newest drawing of each robot's program, for those who may read them."""

from collections.abc import Iterable

from runtime.bus.contract import Bus, ReceivedMessage
from schemas.messages.debug import SHOWN_S, RobotDebug
from schemas.side import Side
from schemas.topics import DEBUG
from schemas.wire.message import valid


class DebugFollower:
    """Keeps the newest drawing of each robot; of an account without the right to read them it has none."""

    def __init__(self, bus: Bus) -> None:
        self._drawings = bus.subscribe(DEBUG, newest=True)
        self._newest: dict[str, ReceivedMessage] = {}
        self._read: dict[str, RobotDebug | None] = {}
        """Robot → its newest drawing, if it was asked for; None for an invalid one."""

    def update(self) -> None:
        """Take in the drawings received since the last call, without waiting."""
        for received in iter(self._drawings.receive, None):
            robot = received.chunks["robot"]
            self._newest[robot] = received
            self._read.pop(robot, None)

    def clear(self) -> None:
        """Forget all drawings: another host plays."""
        self._newest.clear()
        self._read.clear()

    def shown(self, time: float, sides: Iterable[Side] = tuple(Side)) -> dict[str, RobotDebug]:
        """Robot → its drawing at this simulated time in s, of robots of these sides, in the field frame."""
        wanted = {side.value for side in sides}
        robots = [name for name, received in self._newest.items() if received.chunks["side"] in wanted]
        self._read |= {robot: valid(self._newest[robot].message) for robot in robots if robot not in self._read}
        drawings = {robot: drawing for robot in robots if (drawing := self._read[robot]) is not None}
        return {robot: drawing for robot, drawing in drawings.items() if abs(time - drawing.time) <= SHOWN_S}
