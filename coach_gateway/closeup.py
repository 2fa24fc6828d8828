"""A match seen closely: state, events and health, where everybody is, what robots say, what they were ordered."""

from coach_gateway.orders import OrderWatch
from coach_gateway.view import MatchView
from schemas.bus.contract import Bus
from schemas.command import Radio
from schemas.host import Belief
from schemas.message import BadMessageError
from schemas.topics import BELIEF, WORLD
from schemas.world import World


class Closeup:
    """The newest of a match, as the bus brings it."""

    def __init__(self, bus: Bus) -> None:
        self.match = MatchView(bus, past=True)
        self.world: World | None = None
        self.words: dict[str, Radio] = {}
        """Robot → what it said last on the radio."""
        self.orders = OrderWatch(bus)
        self._worlds = bus.subscribe(WORLD, newest=True)
        self._beliefs = bus.subscribe(BELIEF, newest=True)

    def update(self) -> None:
        """Take in what has come, without waiting; of the worlds since the last call the newest alone."""
        self.match.update()
        self.orders.update()
        try:
            while (received := self._worlds.receive()) is not None:
                self.world = received.message()
            while (received := self._beliefs.receive()) is not None:
                belief: Belief = received.message()
                self.words[belief.robot] = belief.radio
        except BadMessageError:
            self.match.unreadable += 1
