"""Which order stands for each side, and which robots have acknowledged it: the tracker that every bridge uses.

The host says both on `team/{side}/standing`: on change, and once a simulated second for those who come later.
`OrderBook` is pure and is told; `OrderFollower` hears it on a bus. `HostClient.order` gives an order,
`HostClient.wait_for_robots` waits for its receipt, and `HostClient.orders.update()` brings the news of all orders,
whoever gave them.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated

from pydantic import Field

from schemas.bus.contract import Bus
from schemas.message import BadMessageError
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.side import Side
from schemas.topics import ACTIVE_ORDER


class OrderContent(CoachOrder):
    """An order that the gateway numbers."""

    sequence: Annotated[int, Field(ge=1)] = 1
    """Filled in by the gateway."""


class OrderStatus(StrEnum):
    """What became of an order."""

    PENDING = "pending"
    """The host has not said yet that it stands."""
    ACTIVE = "active"
    REPLACED = "replaced"
    """One with a larger number stands."""


@dataclass(frozen=True, slots=True)
class Receipt:
    """What is known of one order."""

    status: OrderStatus
    acknowledged: tuple[str, ...] = ()
    """Robots that have taken it in."""
    missing: tuple[str, ...] = ()
    """Robots of the side that have not."""

    @property
    def is_final(self) -> bool:
        """Nothing more is to be waited for."""
        return self.status is OrderStatus.REPLACED or (self.status is OrderStatus.ACTIVE and not self.missing)

    def __str__(self) -> str:
        if self.status is OrderStatus.PENDING:
            return "no robot has had it yet"
        if self.status is OrderStatus.REPLACED:
            return "another order with a larger number stands"
        words = [f"acknowledged by {', '.join(self.acknowledged)}" if self.acknowledged else "acknowledged by nobody"]
        return "; ".join([*words, f"not yet by {', '.join(self.missing)}"] if self.missing else words)


class OrderBook:
    """The newest that was said of each side's order."""

    def __init__(self) -> None:
        self._active: dict[Side, ActiveOrder] = {}

    def update(self, side: Side, active: ActiveOrder) -> bool:
        """Take in what was said; whether it says anything new of order or robots."""
        before = self._active.get(side)
        self._active[side] = active
        return before is None or (before.order, before.acknowledged) != (active.order, active.acknowledged)

    def active(self, side: Side) -> ActiveOrder | None:
        """The order that stands and who has acknowledged it; nothing while none was heard of."""
        return self._active.get(side)

    def receipt(self, side: Side, sequence: int) -> Receipt:
        """What is known of the order of that number."""
        active = self._active.get(side)
        if active is None or active.order.sequence < sequence:
            return Receipt(OrderStatus.PENDING)
        if active.order.sequence > sequence:
            return Receipt(OrderStatus.REPLACED)
        robots = active.acknowledged
        return Receipt(
            OrderStatus.ACTIVE,
            tuple(name for name, has in robots.items() if has),
            tuple(name for name, has in robots.items() if not has),
        )

    def clear(self) -> None:
        """Another host plays: no order stands there."""
        self._active.clear()


class OrderFollower:
    """Hears what the host says of the orders."""

    def __init__(self, bus: Bus, book: OrderBook | None = None) -> None:
        """`book` is filled in; without one a new one is."""
        self._subscription = bus.subscribe(ACTIVE_ORDER)
        self.book = book if book is not None else OrderBook()
        self.unreadable = 0
        """Messages that could not be read; each was left out."""

    def update(self) -> list[Side]:
        """Take in what has come, without waiting; returns the sides that there is news of, in the order it came."""
        news: dict[Side, None] = {}
        while (received := self._subscription.receive()) is not None:
            try:
                side, active = Side(received.chunks["side"]), received.message()
            except (BadMessageError, ValueError):
                self.unreadable += 1
                continue
            if self.book.update(side, active):
                news[side] = None
        return list(news)
