"""A match seen closely: state, events and health, where everybody is, what robots say, what they were ordered."""

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.orders import OrderFollower
from schemas.bus.contract import Bus
from schemas.message import BadMessageError
from schemas.messages.command import Radio
from schemas.messages.host import Belief
from schemas.messages.world import World
from schemas.topics import BELIEF, WORLD


class DetailedFollower:
    """The newest of a match, as the bus brings it."""

    def __init__(self, bus: Bus) -> None:
        self.match = MatchFollower(bus, past=True)
        self.world: World | None = None
        self.radios: dict[str, Radio] = {}
        """Robot → what it said last on the radio."""
        self.orders = OrderFollower(bus)
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
                self.radios[belief.robot] = belief.radio
        except BadMessageError:
            self.match.unreadable += 1
