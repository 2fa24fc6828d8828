"""Where others put questions to the host: one clerk for each kind, all attended to between two ticks."""

from collections.abc import Callable, Sequence

from schemas.bus.contract import Bus
from schemas.bus.minutes import MinuteKeeper
from schemas.game import ActionReply, RefereeAction
from schemas.topics import PARAMETERS, SCENE, SETUP
from sim_host.clerks.actions import ActionClerk
from sim_host.clerks.orders import OrderClerk
from sim_host.clerks.prompt import PromptClerk
from sim_host.complaints import Complaints
from sim_host.simulation import Simulation


class Desk:
    """Answers between two ticks."""

    def __init__(
        self,
        bus: Bus,
        simulation: Simulation,
        complaints: Complaints,
        minutes: MinuteKeeper,
        officiated: Callable[[], bool],
    ) -> None:
        """`officiated` tells whether a league's referee box decides: then nobody else does."""
        self._setup = PromptClerk(bus, SETUP, lambda _: simulation.setup(), complaints)
        self._parameters = PromptClerk(bus, PARAMETERS, simulation.parameters, complaints)
        self._scene = PromptClerk(bus, SCENE, simulation.scene, complaints)
        self._orders = OrderClerk(bus, simulation.orders, complaints, minutes)
        self._actions = ActionClerk(bus, complaints, officiated)

    @property
    def actions(self) -> Sequence[RefereeAction]:
        """Noted, and to be put to the referee in the next tick."""
        return self._actions.actions

    def attend(self) -> None:
        """Take in orders, answer what can be answered at once, and note the actions asked for.

        Who asks for the setup after giving an order knows by the answer that the order was taken in.
        """
        for clerk in (self._orders, self._parameters, self._scene, self._setup, self._actions):
            clerk.attend()

    def tell_setup(self) -> None:
        """Say how the match is set up to whoever asks; an agent that is waited for may have to know first."""
        self._setup.attend()

    def reply(self, replies: Sequence[ActionReply]) -> None:
        """Answer the actions noted, in order, and forget them."""
        self._actions.reply(replies)

    def refuse(self, reason: str) -> None:
        """Answer the actions noted with a refusal, and forget them."""
        self._actions.refuse(reason)
