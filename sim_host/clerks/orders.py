"""The clerk who takes in the coaches' orders: the newest of each side stands."""

from schemas.bus.contract import Bus, Received
from schemas.bus.minutes import MinuteKeeper
from schemas.coach import CoachOrder
from schemas.message import BadMessageError
from schemas.side import Side
from schemas.topics import ORDER
from sim_host.complaints import Complaints


class OrderClerk:
    """Keeps the standing orders."""

    def __init__(
        self, bus: Bus, standing: dict[Side, CoachOrder], complaints: Complaints, minutes: MinuteKeeper
    ) -> None:
        """`standing` is where the orders are kept: side → its newest."""
        self._orders = bus.subscribe(ORDER)
        self._standing = standing
        self._complaints = complaints
        self._minutes = minutes

    def attend(self) -> None:
        """Take in what has come."""
        while (received := self._orders.receive()) is not None:
            self._minutes.note(received)
            try:
                order, side = received.message(), _side_of(received)
            except BadMessageError as error:
                self._complaints.note(received.key, str(error), received.payload)
                continue
            standing = self._standing.get(side)
            if order == standing:
                continue  # said twice
            reason = order.why_not_after(standing)
            if reason:
                self._complaints.note(received.key, reason, received.payload)
            else:
                self._standing[side] = order


def _side_of(received: Received) -> Side:
    side = received.chunks["side"]
    if side not in [known.value for known in Side]:
        raise BadMessageError(f"no side is named {side}")
    return Side(side)
