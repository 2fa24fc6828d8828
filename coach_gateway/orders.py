"""Which order stands for each side, and which robots have acknowledged it: the tracker that every bridge uses.

The host says both on `team/{side}/standing`: on change, and once a simulated second for those who come later.
`OrderBook` is pure and is told; `OrderWatch` hears it on a bus. `Gateway.order` gives an order,
`Gateway.wait_for_robots` waits for its receipt, and `Gateway.orders.update()` brings the news of all orders, whoever
gave them.
"""

from dataclasses import dataclass
from enum import StrEnum

from schemas.bus.contract import Bus
from schemas.coach import StandingOrder
from schemas.message import BadMessageError
from schemas.side import Side
from schemas.topics import STANDING_ORDER


class Fate(StrEnum):
    """What became of an order."""

    UNHEARD = "unheard"
    """The host has not said yet that it stands."""
    STANDS = "stands"
    REPLACED = "replaced"
    """One with a larger number stands."""


@dataclass(frozen=True, slots=True)
class Receipt:
    """What is known of one order."""

    fate: Fate
    acknowledged: tuple[str, ...] = ()
    """Robots that have taken it in."""
    missing: tuple[str, ...] = ()
    """Robots of the side that have not."""

    @property
    def is_final(self) -> bool:
        """Nothing more is to be waited for."""
        return self.fate is Fate.REPLACED or (self.fate is Fate.STANDS and not self.missing)

    def __str__(self) -> str:
        if self.fate is Fate.UNHEARD:
            return "no robot has had it yet"
        if self.fate is Fate.REPLACED:
            return "another order with a larger number stands"
        words = [f"acknowledged by {', '.join(self.acknowledged)}" if self.acknowledged else "acknowledged by nobody"]
        return "; ".join([*words, f"not yet by {', '.join(self.missing)}"] if self.missing else words)


class OrderBook:
    """The newest that was said of each side's order."""

    def __init__(self) -> None:
        self._standing: dict[Side, StandingOrder] = {}

    def take(self, side: Side, standing: StandingOrder) -> bool:
        """Take in what was said; whether it says anything new of order or robots."""
        before = self._standing.get(side)
        self._standing[side] = standing
        return before is None or (before.order, before.acknowledged) != (standing.order, standing.acknowledged)

    def standing(self, side: Side) -> StandingOrder | None:
        """The order that stands and who has acknowledged it; nothing while none was heard of."""
        return self._standing.get(side)

    def receipt(self, side: Side, sequence: int) -> Receipt:
        """What is known of the order of that number."""
        standing = self._standing.get(side)
        if standing is None or standing.order.sequence < sequence:
            return Receipt(Fate.UNHEARD)
        if standing.order.sequence > sequence:
            return Receipt(Fate.REPLACED)
        robots = standing.acknowledged
        return Receipt(
            Fate.STANDS,
            tuple(name for name, has in robots.items() if has),
            tuple(name for name, has in robots.items() if not has),
        )

    def forget(self) -> None:
        """Another host plays: no order stands there."""
        self._standing.clear()


class OrderWatch:
    """Hears what the host says of the orders."""

    def __init__(self, bus: Bus) -> None:
        self._said = bus.subscribe(STANDING_ORDER)
        self.book = OrderBook()
        self.unreadable = 0
        """Messages that could not be read; each was left out."""

    def update(self) -> list[Side]:
        """Take in what has come, without waiting; returns the sides that there is news of, in the order it came."""
        news: dict[Side, None] = {}
        while (received := self._said.receive()) is not None:
            try:
                side, standing = Side(received.chunks["side"]), received.message()
            except (BadMessageError, ValueError):
                self.unreadable += 1
                continue
            if self.book.take(side, standing):
                news[side] = None
        return list(news)
