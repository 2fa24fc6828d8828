"""Tells each coach which robots have taken in the order that stands."""

from collections.abc import Mapping

from schemas.bus.minutes import MinuteKeeper
from schemas.coach import CoachOrder, StandingOrder
from schemas.side import Side
from schemas.topics import STANDING_ORDER
from sim_host.inbox import Ledger
from sim_host.snapshot import Roster

_AGAIN_S = 1.0
"""Simulated time after which what has not changed is said again, for a coach who has come meanwhile."""


class StandingOrders:
    """The standing order of each side as it is told."""

    def __init__(
        self,
        minutes: MinuteKeeper,
        orders: Mapping[Side, CoachOrder],
        ledgers: Mapping[str, Ledger],
        tick_s: float,
    ) -> None:
        """`orders` are those that stand, kept up to date by somebody else, as the `ledgers` are."""
        self._orders = orders
        self._ledgers = ledgers
        self._writers = {side: minutes.publisher(STANDING_ORDER, side=side.value) for side in Side}
        self._every = round(_AGAIN_S / tick_s)
        self._told: dict[Side, tuple[int, dict[str, bool]]] = {}

    def tell(self, tick: int, time: float, roster: Roster) -> None:
        """Say what has changed, and once a second what has not; nothing of a side that no order was given."""
        for side, order in self._orders.items():
            acknowledged = {
                name: self._ledgers[name].acknowledged == order.sequence
                for name, own in zip(roster.names, roster.sides, strict=True)
                if own is side and name not in roster.still
            }
            if self._told.get(side) == (order.sequence, acknowledged) and tick % self._every:
                continue
            self._told[side] = order.sequence, acknowledged
            self._writers[side].put(StandingOrder(tick=tick, time=time, order=order, acknowledged=acknowledged))
