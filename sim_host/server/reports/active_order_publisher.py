"""Publishes the active order of each side, with the robots that have acknowledged it."""

from collections.abc import Mapping

from runtime.bus.batch_publisher import BatchPublisher
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.side import Side
from schemas.topics import ACTIVE_ORDER
from sim_host.server.admission.door import AgentStats
from sim_host.snapshot import Roster

_PERIOD_S = 1.0
"""Simulated time after which an unchanged order is published again, for coaches that have connected since."""


class ActiveOrderPublisher:
    """Publishes the active orders when they or their acknowledgements change."""

    def __init__(
        self,
        batches: BatchPublisher,
        orders: Mapping[Side, CoachOrder],
        agent_stats: Mapping[str, AgentStats],
        tick_s: float,
    ) -> None:
        """`orders` and `agent_stats` are live: the caller keeps both up to date."""
        self._orders = orders
        self._agent_stats = agent_stats
        self._writers = {side: batches.publisher(ACTIVE_ORDER, side=side.value) for side in Side}
        self._every = round(_PERIOD_S / tick_s)
        self._published: dict[Side, tuple[int, dict[str, bool], dict[str, str]]] = {}

    def publish(self, tick: int, time: float, roster: Roster) -> None:
        """Publish what has changed, and once a second what has not. A side without an order has nothing to publish."""
        for side, order in self._orders.items():
            acknowledged = {
                name: self._agent_stats[name].acknowledged == order.sequence
                for name, own in zip(roster.names, roster.sides, strict=True)
                if own is side and name not in roster.still
            }
            refused = {
                name: self._agent_stats[name].refused_order
                for name, has in acknowledged.items()
                if has and self._agent_stats[name].refused_order
            }
            if self._published.get(side) == (order.sequence, acknowledged, refused) and tick % self._every:
                continue
            self._published[side] = order.sequence, acknowledged, refused
            self._writers[side].put(
                ActiveOrder(tick=tick, time=time, order=order, acknowledged=acknowledged, refused=refused)
            )
