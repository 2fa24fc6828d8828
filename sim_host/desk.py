"""Where others put questions to the host: how the match is set up, referee actions, and the coaches' orders."""

from collections.abc import Sequence

from schemas.bus.contract import Bus, Question, Received
from schemas.game import ActionReply, RefereeAction
from schemas.host import Setup
from schemas.message import BadMessageError
from schemas.side import Side
from schemas.topics import ACTION, ORDER, SETUP
from sim_host.complaints import Complaints
from sim_host.simulation import Simulation


class Desk:
    """Answers between two ticks."""

    def __init__(self, bus: Bus, simulation: Simulation, complaints: Complaints) -> None:
        self._simulation = simulation
        self._complaints = complaints
        self._setup_reply: Setup = simulation.setup()
        self._setups = bus.serve(SETUP)
        self._questions = bus.serve(ACTION)
        self._orders = bus.subscribe(ORDER)
        self._asked: list[Question] = []
        self.actions: list[RefereeAction] = []
        """Noted, and to be put to the referee in the next tick."""

    def attend(self) -> None:
        """Answer what can be answered at once, take in orders, and note the actions asked for."""
        self.tell_setup()
        self._take_orders()
        while (question := self._questions.receive()) is not None:
            try:
                self.actions.append(question.message())
                self._asked.append(question)
            except BadMessageError as error:
                self._complaints.note(question.key, str(error), question.payload)
                question.fail(str(error))

    def tell_setup(self) -> None:
        """Say how the match is set up to whoever asks; an agent that is waited for may have to know first."""
        while (question := self._setups.receive()) is not None:
            question.answer(self._setup_reply)

    def reply(self, replies: Sequence[ActionReply]) -> None:
        """Answer the actions noted, in order, and forget them."""
        for question, reply in zip(self._asked, replies, strict=True):
            question.answer(reply)
        self._asked.clear()
        self.actions.clear()

    def refuse(self, reason: str) -> None:
        """Answer the actions noted with a refusal, and forget them."""
        self.reply([ActionReply(accepted=False, reason=reason)] * len(self._asked))

    def _take_orders(self) -> None:
        orders = self._simulation.orders
        while (received := self._orders.receive()) is not None:
            try:
                order, side = received.message(), _side_of(received)
            except BadMessageError as error:
                self._complaints.note(received.key, str(error), received.payload)
                continue
            standing = orders.get(side)
            if standing is None or order.sequence > standing.sequence:
                orders[side] = order


def _side_of(received: Received) -> Side:
    side = received.chunks["side"]
    if side not in [known.value for known in Side]:
        raise BadMessageError(f"no side is named {side}")
    return Side(side)
