"""Tells each coach which robots have taken in the order that stands."""

from collections.abc import Mapping

from schemas.bus.batch_publisher import BatchPublisher
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.side import Side
from schemas.topics import ACTIVE_ORDER
from sim_host.server.agent_stats import AgentStats
from sim_host.snapshot import Roster

_PERIOD_S = 1.0
"""Simulated time after which what has not changed is said again, for a coach who has come meanwhile."""


class ActiveOrderPublisher:
    """The active order of each side as it is published."""

    def __init__(
        self,
        batches: BatchPublisher,
        orders: Mapping[Side, CoachOrder],
        agent_stats: Mapping[str, AgentStats],
        tick_s: float,
    ) -> None:
        """`orders` are those that stand, kept up to date by somebody else, as the `agent_stats` are."""
        self._orders = orders
        self._agent_stats = agent_stats
        self._writers = {side: batches.publisher(ACTIVE_ORDER, side=side.value) for side in Side}
        self._every = round(_PERIOD_S / tick_s)
        self._published: dict[Side, tuple[int, dict[str, bool]]] = {}

    def publish(self, tick: int, time: float, roster: Roster) -> None:
        """Say what has changed, and once a second what has not; nothing of a side that no order was given."""
        for side, order in self._orders.items():
            acknowledged = {
                name: self._agent_stats[name].acknowledged == order.sequence
                for name, own in zip(roster.names, roster.sides, strict=True)
                if own is side and name not in roster.still
            }
            if self._published.get(side) == (order.sequence, acknowledged) and tick % self._every:
                continue
            self._published[side] = order.sequence, acknowledged
            self._writers[side].put(ActiveOrder(tick=tick, time=time, order=order, acknowledged=acknowledged))
