"""The handler of the coaches' orders: the newest order of each side is active."""

from collections.abc import Callable

from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import Bus, ReceivedMessage
from schemas.config.sections import Pitch
from schemas.messages.coach import CoachOrder
from schemas.side import Side
from schemas.topics import ORDER
from schemas.wire.message import BadMessageError
from sim_host.server.admission.door import ORDER_WEIGHT, Admission


class OrderHandler:
    """Keeps the active orders."""

    def __init__(
        self,
        bus: Bus,
        active: dict[Side, CoachOrder],
        pitch: Callable[[], Pitch],
        batches: BatchPublisher,
        admission: Admission,
    ) -> None:
        """`active` maps each side to its newest order, and is updated in place; `pitch` returns the pitch in force."""
        self._orders = bus.subscribe(ORDER)
        self._active = active
        self._pitch = pitch
        self._invalid_log = admission.invalid_log
        self._batches = batches
        self._accounts = admission.accounts

    def process(self) -> None:
        """Process all orders that have arrived."""
        while (received := self._orders.receive()) is not None:
            if not self._accounts.of_key(received.key).accept(len(received.payload), ORDER_WEIGHT):
                continue
            self._batches.add_received(received)
            try:
                order, side = received.message(), _side_of(received)
            except BadMessageError as error:
                self._invalid_log.add(received.key, str(error), received.payload)
                continue
            active = self._active.get(side)
            if order == active:
                continue  # sent twice
            reason = order.refusal_after(active) or order.refusal_on(self._pitch())
            if reason:
                self._invalid_log.add(received.key, reason, received.payload)
            else:
                self._active[side] = order


def _side_of(received: ReceivedMessage) -> Side:
    side = received.chunks["side"]
    if side not in [known.value for known in Side]:
        raise BadMessageError(f"no side is named {side}")
    return Side(side)
