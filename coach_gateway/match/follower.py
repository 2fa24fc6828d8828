"""What can be seen of a match from outside: the newest state and health, all events, and how fast it is played."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from schemas.bus.contract import Bus, ReceivedMessage, Subscription
from schemas.game import GameEvent, GameState, Phase
from schemas.message import BadMessageError
from schemas.messages.host import Health, RecorderProgress
from schemas.topics import EVENT, HEALTH, RECORDER_PROGRESS, STATE

_SETTLES_S = 0.2
"""Wall time without another state after which the last one is the newest: a host's cache may tell the oldest first."""


@dataclass(frozen=True, slots=True)
class MatchTime:
    """A point of the match: its tick, its simulated time in s, and the host's wall time in ns since 1970."""

    tick: int
    time: float
    wall_ns: int


@dataclass
class MatchFollower:
    """The match as the bus brings it; `update` takes in what has come."""

    bus: Bus
    past: bool = False
    """Events of before are wanted, too, as far as the host keeps them."""
    state: GameState | None = None
    health: Health | None = None
    events: list[GameEvent] = field(default_factory=list)
    recorders: dict[str, RecorderProgress] = field(default_factory=dict)
    """What each recorder said last."""
    unreadable: int = 0
    """Messages that could not be read; each was left out."""
    first: MatchTime | None = None
    """The first tick seen."""
    last: MatchTime | None = None
    """The newest tick seen."""

    def __post_init__(self) -> None:
        self._subscriptions: tuple[Subscription, ...] = tuple(
            self.bus.subscribe(topic, history=self.past and topic is EVENT) for topic in (EVENT, STATE, HEALTH)
        )
        self._progress = self.bus.subscribe(RECORDER_PROGRESS)

    def update(self) -> list[GameEvent | GameState | Health]:
        """Take in what has come since the last call, without waiting; returns it, events first."""
        fresh: list[GameEvent | GameState | Health] = []
        for subscription in self._subscriptions:
            while (received := subscription.receive()) is not None:
                message = self._read(received)
                if message is not None:
                    fresh.append(message)
        while (received := self._progress.receive()) is not None:
            self._note_progress(received)
        return fresh

    def complete(self, messages: Iterable[ReceivedMessage]) -> list[GameEvent | GameState | Health]:
        """Take in what was told and has not come, from whoever kept it; returns what of it is new, in its order."""
        fresh = []
        for received in messages:
            message = self._decoded(received)
            is_known = message in self.events if isinstance(message, GameEvent) else self._is_past(message)
            if message is not None and not is_known:
                self._update_with(message, received)
                fresh.append(message)
        self.events.sort(key=lambda event: event.tick)
        return fresh

    def wait_for_state(self, patience: float) -> GameState | None:
        """The newest state, waiting up to `patience` s of wall time for the first and those right behind it."""
        clock = self.bus.clock
        deadline = clock.now() + patience
        settled = deadline if self.state is None else clock.now()
        while clock.now() < min(deadline, settled):
            before = self.state
            self.update()
            if self.state is not before:
                settled = clock.now() + _SETTLES_S
            clock.sleep_until(clock.now() + 0.02)
        return self.state

    @property
    def finished(self) -> bool:
        """Whether full time was seen."""
        return self.state is not None and self.state.phase is Phase.FULL_TIME

    @property
    def wall_s(self) -> float:
        """Wall time in s between the first and the newest tick seen."""
        return (self.last.wall_ns - self.first.wall_ns) / 1e9 if self.first and self.last else 0.0

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds per wall second over all that was seen; 0 when that is nothing."""
        if self.first is None or self.last is None or self.wall_s <= 0.0:
            return 0.0
        return (self.last.time - self.first.time) / self.wall_s

    def _note_progress(self, received: ReceivedMessage) -> None:
        try:
            self.recorders[received.chunks["name"]] = received.message()
        except BadMessageError:
            self.unreadable += 1

    def _is_past(self, message: GameState | Health | None) -> bool:
        """Whether something as new has been seen."""
        seen = self.state if isinstance(message, GameState) else self.health
        return message is not None and seen is not None and message.tick <= seen.tick

    def _read(self, received: ReceivedMessage) -> GameEvent | GameState | Health | None:
        message = self._decoded(received)
        if message is not None:
            self._update_with(message, received)
        return message

    def _decoded(self, received: ReceivedMessage) -> GameEvent | GameState | Health | None:
        try:
            message: GameEvent | GameState | Health = received.message()
        except BadMessageError:
            self.unreadable += 1
            return None
        return message

    def _update_with(self, message: GameEvent | GameState | Health, received: ReceivedMessage) -> None:
        match message:
            case GameEvent():
                self.events.append(message)
            case GameState():
                self.state = message
            case Health():
                self.health = message
        if message.tick > 0 and received.stamp is not None:
            self._note_time(MatchTime(message.tick, message.time, received.stamp.sent_ns))

    def _note_time(self, time: MatchTime) -> None:
        if self.first is None or time.tick < self.first.tick:
            self.first = time
        if self.last is None or time.tick >= self.last.tick:
            self.last = time
