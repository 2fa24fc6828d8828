"""Where others put questions to the host: one handler for each kind, all attended to between two ticks."""

from collections.abc import Callable, Sequence

from schemas.bus.batch_publisher import BatchPublisher
from schemas.bus.contract import Bus
from schemas.game import ActionReply, RefereeAction
from schemas.topics import PARAMETERS, SCENE, SETUP
from sim_host.match.simulation import Simulation
from sim_host.server.invalid_log import InvalidLog
from sim_host.server.services.action_handler import ActionHandler
from sim_host.server.services.order_handler import OrderHandler
from sim_host.server.services.query_handler import QueryHandler


class Services:
    """Answers between two ticks."""

    def __init__(
        self,
        bus: Bus,
        simulation: Simulation,
        invalid_log: InvalidLog,
        batches: BatchPublisher,
        has_referee_box: Callable[[], bool],
    ) -> None:
        """`has_referee_box` tells whether a league's referee box decides: then nobody else does."""
        self._batches = batches
        self._setup = QueryHandler(bus, SETUP, lambda _: simulation.setup(), invalid_log)
        self._parameters = QueryHandler(bus, PARAMETERS, simulation.handle_parameters, invalid_log)
        self._scene = QueryHandler(bus, SCENE, simulation.handle_scene, invalid_log)
        self._orders = OrderHandler(bus, simulation.orders, invalid_log, batches)
        self._actions = ActionHandler(bus, invalid_log, has_referee_box)

    @property
    def actions(self) -> Sequence[RefereeAction]:
        """Noted, and to be put to the referee in the next tick."""
        return self._actions.actions

    def process(self) -> None:
        """Take in orders, answer what can be answered at once, and note the actions asked for.

        Who asks for the setup after giving an order knows by the answer that the order was taken in.
        """
        for handler in (self._orders, self._parameters, self._scene, self._setup, self._actions):
            handler.process()
        self._batches.process()

    def attend_meanwhile(self) -> None:
        """Answer what may not wait for the end of a tick.

        An agent that is waited for may have to know the setup first, a recorder that is waited for may need batches.
        """
        self._setup.process()
        self._batches.process()

    def reply(self, replies: Sequence[ActionReply]) -> None:
        """Answer the actions noted, in order, and forget them."""
        self._actions.reply(replies)

    def refuse(self, reason: str) -> None:
        """Answer the actions noted with a refusal, and forget them."""
        self._actions.refuse(reason)
