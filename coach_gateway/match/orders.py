"""Which order is active for each side, and which robots have acknowledged it.

The host publishes both on `team/{side}/standing`: on change, and once a simulated second for late subscribers.
`OrderBook` is pure and keeps them; `OrderFollower` fills it from a bus. `HostClient.order` sends an order,
`HostClient.wait_for_robots` waits for its receipt, and `HostClient.orders.update()` returns news of all orders,
including those of other clients.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Annotated, Any

from msgspec import Meta

from runtime.bus.contract import Bus
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.side import Side
from schemas.topics import ACTIVE_ORDER
from schemas.wire.message import BadMessageError


class OrderContent(CoachOrder, frozen=True, kw_only=True):
    """An order that the gateway numbers."""

    sequence: Annotated[int, Meta(ge=1)] = 1
    """Filled in by the gateway."""

    def content(self) -> dict[str, Any]:
        """The fields that describe what the robots do."""
        return {name: getattr(self, name) for name in self.__struct_fields__ if name not in ("version", "sequence")}


class OrderStatus(StrEnum):
    """How far an order has come."""

    PENDING = "pending"
    """The host has not published yet that it is active."""
    ACTIVE = "active"
    REPLACED = "replaced"
    """An order with a larger number is active."""


@dataclass(frozen=True, slots=True)
class Receipt:
    """What is known of one order."""

    status: OrderStatus
    acknowledged: tuple[str, ...] = ()
    """Robots that have acknowledged it."""
    missing: tuple[str, ...] = ()
    """Robots of the side that have not."""
    refused: Mapping[str, str] = field(default_factory=dict)
    """Robot that does not carry it out → the reason."""

    @property
    def is_final(self) -> bool:
        """Whether the receipt will not change any more."""
        return self.status is OrderStatus.REPLACED or (self.status is OrderStatus.ACTIVE and not self.missing)

    def __str__(self) -> str:
        if self.status is OrderStatus.PENDING:
            return "no robot has received it yet"
        if self.status is OrderStatus.REPLACED:
            return "replaced by an order with a larger number"
        follow = [name for name in self.acknowledged if name not in self.refused]
        words = [f"acknowledged by {', '.join(follow)}"] if follow else []
        if not self.acknowledged:
            words = ["acknowledged by no robot"]
        words += [f"refused by {', '.join(names)}: {why}" for why, names in _by_reason(self.refused).items()]
        return "; ".join([*words, f"not yet by {', '.join(self.missing)}"] if self.missing else words)


class OrderBook:
    """The newest of each side's order."""

    def __init__(self) -> None:
        self._active: dict[Side, ActiveOrder] = {}

    def update(self, side: Side, active: ActiveOrder) -> bool:
        """Take in an active order; returns whether order or acknowledgements are new."""
        before = self._active.get(side)
        self._active[side] = active
        return before is None or active.replace(tick=before.tick, time=before.time) != before

    def active(self, side: Side) -> ActiveOrder | None:
        """The active order and its acknowledgements; None before any was published."""
        return self._active.get(side)

    def receipt(self, side: Side, sequence: int) -> Receipt:
        """The receipt of the order of that number."""
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
            active.refused,
        )

    def clear(self) -> None:
        """Forget all orders: they were another host's."""
        self._active.clear()


def _by_reason(refused: Mapping[str, str]) -> dict[str, list[str]]:
    """Reason → the robots that give it."""
    found: dict[str, list[str]] = {}
    for name, why in refused.items():
        found.setdefault(why, []).append(name)
    return found


class OrderFollower:
    """Follows the orders that the host publishes."""

    def __init__(self, bus: Bus, book: OrderBook | None = None) -> None:
        """Fills `book`; by default a new one."""
        self._subscription = bus.subscribe(ACTIVE_ORDER)
        self.book = book if book is not None else OrderBook()

    def update(self) -> list[Side]:
        """Take in what has come, without waiting; returns the sides with news, in the order it came."""
        news: dict[Side, None] = {}
        while (received := self._subscription.receive()) is not None:
            try:
                side, active = Side(received.chunks["side"]), received.message()
            except (BadMessageError, ValueError):
                continue
            if self.book.update(side, active):
                news[side] = None
        return list(news)
