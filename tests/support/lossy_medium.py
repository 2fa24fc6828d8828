"""An in-process bus that loses messages, as a network does."""

from dataclasses import dataclass, field

from runtime.bus.contract import Publisher, Stamp
from runtime.process.clock import Clock
from schemas.topic import Topic
from support.in_process_bus import InProcessBus, SharedState


@dataclass
class Losses:
    """The lost messages of one key."""

    numbers: set[int]
    """Numbers of the messages that do not arrive, from 1."""
    sent: list[bytes] = field(default_factory=list)
    """All payloads that were sent, lost or not."""


@dataclass(eq=False)
class LossyMedium(SharedState):
    """Loses the messages that `lose` names."""

    losses: dict[str, Losses] = field(default_factory=dict)
    """Key below the match → its losses."""

    def open_bus(self, match: str, clock: Clock) -> InProcessBus:
        return _LossyBus(match, clock, self, self.losses)

    def lose(self, key: str, numbers: set[int]) -> Losses:
        """Lose messages of a key, counted from the next one on."""
        self.losses[key] = Losses(numbers)
        return self.losses[key]


class _LossyBus(InProcessBus):
    def __init__(self, match: str, clock: Clock, medium: SharedState, losses: dict[str, Losses]) -> None:
        super().__init__(match, clock, medium)
        self._losses = losses

    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        return _LossyPublisher(super().publisher(topic, **chunks), self._losses)


class _LossyPublisher(Publisher):
    def __init__(self, publisher: Publisher, losses: dict[str, Losses]) -> None:
        super().__init__(publisher.topic, publisher.key)
        self._publisher, self._losses = publisher, losses

    def put_payload(self, payload: bytes) -> Stamp:
        return Stamp(-1, 0, 0) if self._is_lost(payload) else self._publisher.put_payload(payload)

    def put_copy(self, payload: bytes, stamp: Stamp) -> None:
        if not self._is_lost(payload):
            self._publisher.put_copy(payload, stamp)

    def _is_lost(self, payload: bytes) -> bool:
        losses = self._losses.get(self.key)
        if losses is None:
            return False
        losses.sent.append(payload)
        return len(losses.sent) in losses.numbers

    def has_subscribers(self) -> bool:
        return self._publisher.has_subscribers()
