"""The services of the host on the bus: one handler for each kind of request, all processed between two ticks."""

from collections.abc import Callable

from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import Bus
from schemas.topics import ADMISSION, PACE, PARAMETERS, REFEREE_SEAT, SCENE, SETUP
from sim_host.match.simulation import Simulation
from sim_host.server.admission.door import Admission
from sim_host.server.services.action_handler import ActionHandler
from sim_host.server.services.order_handler import OrderHandler
from sim_host.server.services.pause import Pause
from sim_host.server.services.query_handler import QueryHandler
from sim_host.server.services.referee_seat import RefereeSeat


class Services:
    """All services of a host, processed between two ticks."""

    def __init__(
        self,
        bus: Bus,
        simulation: Simulation,
        batches: BatchPublisher,
        seat: RefereeSeat,
        admission: Admission,
        report_refusal: Callable[[str], None],
    ) -> None:
        """`report_refusal` receives the reason why a process gets no setup, which is what it asks for first."""
        self._batches, invalid_log = batches, admission.invalid_log
        self._setup = QueryHandler(
            bus,
            SETUP,
            lambda _: simulation.setup().replace(claims=True),
            invalid_log,
            lambda reason: report_refusal(f"a process was refused: {reason}"),
        )
        self._parameters = QueryHandler(bus, PARAMETERS, simulation.handle_parameters, invalid_log)
        self._scene = QueryHandler(bus, SCENE, simulation.handle_scene, invalid_log)
        self.pause = Pause(lambda: simulation.now.tick, lambda: simulation.over)
        self._pace = QueryHandler(bus, PACE, self.pause.handle, invalid_log)
        self._seat = QueryHandler(bus, REFEREE_SEAT, seat.handle, invalid_log)
        self._orders = OrderHandler(bus, simulation.orders, lambda: simulation.profile.field, batches, admission)
        self._admission = QueryHandler(bus, ADMISSION, admission.recorders.handle, invalid_log)
        self.requests = ActionHandler(bus, invalid_log, seat)
        """The requested actions, which the referee decides on in the next tick."""

    def process(self) -> None:
        """Receive orders, reply to queries, and queue the requested actions.

        Orders come first: a client that queries the setup after sending an order sees the order in the reply.
        """
        for handler in (
            self._orders,
            self._parameters,
            self._scene,
            self._pace,
            self._setup,
            self._seat,
            self._admission,
            self.requests,
        ):
            handler.process()
        self._batches.process()

    def wait_for_operator(self, timeout: float) -> None:
        """Wait up to `timeout` s of wall time for a request about the pace, and process it."""
        self._pace.process(timeout)

    def serve_while_waiting(self) -> None:
        """Serve the requests that cannot wait for the end of a tick.

        The host may be waiting for an agent that needs the setup first, or for a recorder that needs batches.
        An operator may want to pause just then.
        """
        self._setup.process()
        self._admission.process()
        self._pace.process()
        self._batches.process()
