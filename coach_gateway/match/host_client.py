"""Requests to the host: actions of the referee, orders to a side, live parameters, scenes, replay, and the setup."""

from typing import Any, TypeVar

from coach_gateway.access.referee_name import gateway_name
from coach_gateway.match.orders import OrderFollower, Receipt
from coach_gateway.match.team_names import SIDES_ALONE, TeamNames
from coach_gateway.timing import POLL_S
from runtime.bus.contract import Bus, NoReplyError, PresenceKind, Publisher, RefusedQueryError
from runtime.process.timing import REQUEST_S
from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.coach import CoachOrder
from schemas.messages.setup import Setup, SetupRequest
from schemas.messages.soccer.game import ActionReply, RefereeAction
from schemas.messages.soccer.referee_seat import SeatOperation, SeatReply, SeatRequest
from schemas.side import Side
from schemas.topic import Topic
from schemas.topics import ACTION, ORDER, REFEREE_SEAT, SETUP
from schemas.wire.faults import FaultError
from schemas.wire.message import BadMessageError, Message
from schemas.wire.part_faults import validated

M = TypeVar("M", RefereeAction, SeatRequest)


class HostClient:
    """One client of a match's host."""

    def __init__(self, bus: Bus, patience: float = REQUEST_S) -> None:
        self._bus = bus
        self._patience = patience
        """How long a reply may take, in s of wall time."""
        self._orders: dict[Side, Publisher] = {}
        self._sequence = 0
        self._watch: OrderFollower | None = None

    def ask(self, topic: Topic, request: Message, patience: float | None = None) -> Any:
        """The reply to a query; of a request that changes something, it has whether it was accepted, and why not.

        It may take `patience` s of wall time; by default that of this client.

        Raises:
            TouchlineError: no host answers for this match, or on the topic of replays no replay.
        """
        try:
            wait = self._patience if patience is None else patience
            return self._bus.query(topic, request, wait).result(wait)
        except NoReplyError as error:
            is_refused = isinstance(error, RefusedQueryError)
            remedy = "" if is_refused else "; name the match that the host plays with --match"
            raise TouchlineError(f'match "{self._bus.match}": {error}{remedy}') from None
        except BadMessageError as error:
            raise TouchlineError(f"{topic.key}: the host's reply cannot be read: {error}") from None

    def setup(self) -> Setup:
        """How the match is set up.

        Raises:
            TouchlineError: no host answers for this match.
        """
        setup: Setup = self.ask(SETUP, SetupRequest())
        return setup

    def team_names(self) -> TeamNames:
        """The teams' names; of a host that publishes no setup, the sides."""
        try:
            return TeamNames.of_setup(self.setup())
        except TouchlineError:
            return SIDES_ALONE

    def act(self, action: RefereeAction, patience: float | None = None) -> ActionReply:
        """Ask the referee for an action; the reply, within `patience` s, has whether it was accepted, and why not.

        Raises:
            TouchlineError: no host answers for this match.
        """
        reply: ActionReply = self.ask(ACTION, action if action.referee else self._named(action), patience)
        return reply

    def referee_seat(self, operation: SeatOperation, source: str = "coach") -> SeatReply:
        """Show, take or leave the seat of the referee; the reply has who holds it.

        Raises:
            TouchlineError: no host answers for this match.
        """
        reply: SeatReply = self.ask(REFEREE_SEAT, self._named(SeatRequest(operation=operation, source=source)))
        return reply

    def _named(self, request: M) -> M:
        """The request with the name of this referee, whose presence the host sees as long as its connection is open."""
        name = gateway_name(self._bus.name)
        self._bus.declare_alive(PresenceKind.REFEREE, name)
        return request.replace(referee=name)

    @property
    def orders(self) -> OrderFollower:
        """Active orders and their acknowledgements, from the first use of this property on."""
        if self._watch is None:
            self._watch = OrderFollower(self._bus)
        return self._watch

    def order(self, side: Side, **content: Any) -> CoachOrder:
        """Send a side its new order, numbered after all before it; returns it once the host has it.

        Raises:
            TouchlineError: no host answers for this match, a robot named in the order is not in it, or a field is
                invalid, or a point of it is outside the field.
        """
        setup = self.setup()
        robots = setup.teams[side].robots
        for key in ("robot_a", "robot_b"):
            name = content.get(key)
            if name is not None and name not in robots:
                raise TouchlineError(f'{key} is "{name}", no robot of {side.value}; {did_you_mean(name, robots)}')
        self._sequence = self._next_number(side, setup)
        try:
            order = validated(CoachOrder, {**content, "sequence": self._sequence})
        except FaultError as error:
            raise TouchlineError(f"the order cannot be given: {error}") from None
        if why := order.refusal_on(setup.pitch):
            raise TouchlineError(f"the order cannot be given: {why}")
        if side not in self._orders:
            self._orders[side] = self._bus.publisher(ORDER, side=side.value)
        self._orders[side].put(order)
        self.setup()  # its reply comes after the order on the same link: the host has received the order
        return order

    def wait_for_robots(self, side: Side, order: CoachOrder, patience: float) -> Receipt:
        """The robots that have acknowledged an order, waiting up to `patience` s of wall time for all of them."""
        clock = self._bus.clock
        deadline = clock.now() + patience
        while True:
            self.orders.update()
            receipt = self.orders.book.receipt(side, order.sequence)
            if receipt.is_final or clock.now() >= deadline:
                return receipt
            clock.sleep_until(clock.now() + POLL_S)

    def _next_number(self, side: Side, setup: Setup) -> int:
        """The number of the next order: wall time in ms, or one more than a larger number that is active.

        The setup has the number that was active when the host replied. An order that was published since counts too.
        """
        self.orders.update()
        active = self.orders.book.active(side)
        after = max(active.order.sequence if active is not None else 0, setup.orders.get(side, 0))
        return max(self._sequence + 1, after + 1, self._bus.clock.unix_ns() // 1_000_000)
