"""The core of the coach gateway: asks the referee, orders a side, and knows how the match is set up."""

from typing import Any

from schemas.bus.contract import Bus, NoAnswerError, Publisher
from schemas.coach import CoachOrder
from schemas.errors import TouchlineError, did_you_mean
from schemas.game import ActionReply, RefereeAction
from schemas.host import Setup, SetupRequest
from schemas.message import BadMessageError, Message
from schemas.parameters import ParametersReply, ParametersRequest
from schemas.scene import SceneReply, SceneRequest
from schemas.side import Side
from schemas.topics import ACTION, ORDER, PARAMETERS, SCENE, SETUP, Topic


class Gateway:
    """One coach's seat in a match."""

    def __init__(self, bus: Bus, patience: float = 3.0) -> None:
        self._bus = bus
        self._patience = patience
        """How long an answer may take, in s of wall time."""
        self._orders: dict[Side, Publisher] = {}
        self._sequence = 0

    def setup(self) -> Setup:
        """How the match is set up.

        Raises:
            TouchlineError: no host answers for this match.
        """
        setup: Setup = self._ask(SETUP, SetupRequest())
        return setup

    def act(self, action: RefereeAction) -> ActionReply:
        """Ask the referee for an action; the reply says whether it was accepted, and why not.

        Raises:
            TouchlineError: no host answers for this match.
        """
        reply: ActionReply = self._ask(ACTION, action)
        return reply

    def parameters(self, request: ParametersRequest) -> ParametersReply:
        """Ask for live parameters, or change them; the reply says whether it was accepted, and why not.

        Raises:
            TouchlineError: no host answers for this match.
        """
        reply: ParametersReply = self._ask(PARAMETERS, request)
        return reply

    def scene(self, request: SceneRequest) -> SceneReply:
        """Set bodies down, add or remove some, or begin anew; the reply says whether it was accepted, and why not.

        Raises:
            TouchlineError: no host answers for this match.
        """
        reply: SceneReply = self._ask(SCENE, request)
        return reply

    def order(self, side: Side, **content: Any) -> CoachOrder:
        """Give a side its new standing order, numbered after every one before it; returns it once the host has it.

        Raises:
            TouchlineError: no host answers for this match, or a robot named in the order is not in it.
        """
        robots = self.setup().teams[side].robots
        for key in ("robot_a", "robot_b"):
            name = content.get(key)
            if name is not None and name not in robots:
                raise TouchlineError(f'{key} is "{name}", no robot of {side.value}; {did_you_mean(name, robots)}')
        # Wall time in ms numbers the orders of successive processes too: a coach cannot read what an earlier one said.
        self._sequence = max(self._sequence + 1, self._bus.clock.unix_ns() // 1_000_000)
        order = CoachOrder(sequence=self._sequence, **content)
        if side not in self._orders:
            self._orders[side] = self._bus.publisher(ORDER, side=side.value)
        self._orders[side].put(order)
        self.setup()  # answered after the order on the same link: the host has taken the order in
        return order

    def _ask(self, topic: Topic, question: Message) -> Any:
        try:
            return self._bus.ask(topic, question, self._patience).result(self._patience)
        except NoAnswerError as error:
            raise TouchlineError(
                f'match "{self._bus.match}": {error}; name the match that the host plays with --match'
            ) from None
        except BadMessageError as error:
            raise TouchlineError(f"{topic.key}: the host's answer cannot be read: {error}") from None
