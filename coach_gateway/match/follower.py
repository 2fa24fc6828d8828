"""One follower of a match: subscribes, keeps the newest of each kind, notices another host, and returns what is new.

Everything in the gateway and on the command line that watches a match uses it: the page, coach programs, the referee
box, `touchline watch` and the status line of `touchline match`.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from coach_gateway.match.orders import OrderBook, OrderFollower
from coach_gateway.timing import POLL_S, STATE_SETTLES_S
from runtime.bus.contract import Bus, PresenceKind, PresenceWatch, ReceivedMessage, Stamp, Subscription
from runtime.bus.host_watch import HostWatch
from schemas.messages.health import Health
from schemas.messages.radio import Belief, Radio
from schemas.messages.recorder import RecorderProgress
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import World
from schemas.side import Side
from schemas.soccer.game import Phase
from schemas.topics import BELIEF, EVENT, HEALTH, RECORDER_PROGRESS, STATE, WORLD
from schemas.wire.message import valid

_LATE_TICKS = 50
"""Ticks that a state may be older than one before it. An even older one means that a replay has jumped back."""


@dataclass(frozen=True, slots=True)
class MatchTime:
    """A point of the match: its tick, its simulated time in s, and the host's wall time in ns since 1970."""

    tick: int
    time: float
    wall_ns: int


@dataclass(slots=True)
class MatchNews:
    """What one update has brought."""

    presence_changed: bool = False
    """The host has joined or left."""
    refboxes_changed: bool = False
    """A base station has connected to a referee box, or disconnected."""
    new_host: bool = False
    """Another host plays. The rest of this news is about the new host alone."""
    rewound: bool = False
    """A replay has jumped back."""
    events: list[GameEvent] = field(default_factory=list)
    states: list[GameState] = field(default_factory=list)
    healths: list[Health] = field(default_factory=list)
    world: bool = False
    """A newer tick was received."""
    beliefs: list[str] = field(default_factory=list)
    """Keys of newer beliefs."""
    orders: list[Side] = field(default_factory=list)
    """Sides whose order, or whose acknowledgements, have changed."""

    @property
    def messages(self) -> list[GameEvent | GameState | Health]:
        """Events, then states, then healths."""
        return [*self.events, *self.states, *self.healths]


class _Details(NamedTuple):
    """The subscriptions of a follower with `details`."""

    worlds: Subscription
    beliefs: Subscription
    orders: OrderFollower
    presences: PresenceWatch


class MatchFollower:
    """The match as received from the bus; `update` processes the received messages."""

    def __init__(self, bus: Bus, *, details: bool = False) -> None:
        """`details` adds worlds, beliefs, orders and referee boxes, and the past events that the host still keeps."""
        self.bus = bus
        self.host = HostWatch(bus)
        self.gone = False
        """A host was present and has left."""
        self.host_present = False
        """The host is present."""
        self.host_changes = 0
        """How often another host has taken the place of the one before; the events begin anew with each."""
        self.state: GameState | None = None
        """The newest state. That of an earlier host stays until the next one has published its own."""
        self.health: Health | None = None
        self.events: list[GameEvent] = []
        """The events that the host keeps, in order."""
        self.recorders: dict[str, RecorderProgress] = {}
        """Recorder → its newest progress."""
        self.orders = OrderBook()
        self.refboxes: list[str] = []
        """Names of the sides whose base stations are connected to a referee box."""
        self.first: MatchTime | None = None
        """The first tick seen."""
        self.last: MatchTime | None = None
        """The newest tick seen."""
        self._stamps: dict[str, Stamp] = {}
        """Key → the newest stamp of this host."""
        self._newest_tick = 0
        self._payloads: dict[str, bytes] = {}
        self._world: World | None = None
        self._beliefs: dict[str, Belief] = {}
        self._unread: dict[str, ReceivedMessage] = {}
        self._events = bus.subscribe(EVENT, history=details)
        self._states, self._healths = bus.subscribe(STATE), bus.subscribe(HEALTH)
        self._progress = bus.subscribe(RECORDER_PROGRESS)
        self._details = self._follow_details() if details else None

    def update(self) -> MatchNews:
        """Process the messages received since the last call, without waiting; returns what is new."""
        news = MatchNews()
        was_present, self.gone = self.host_present, self.host.has_left()
        self.host_present = self.host.seen and not self.gone
        news.presence_changed = self.host_present != was_present
        for message, received in self._messages(self._events, news):
            self._add_event(message, received)
            news.events.append(message)
        for message, received in self._messages(self._states, news):
            self._rewind(message, news)
            self._set_state(message, received)
            news.states.append(message)
        for message, received in self._messages(self._healths, news):
            self.health = message
            self._payloads[received.key] = received.payload
            self._note_time(message, received)
            news.healths.append(message)
        for received in iter(self._progress.receive, None):
            if (progress := valid(received.message)) is not None:
                self.recorders[received.chunks["name"]] = progress
        if self._details is not None:
            self._update_details(self._details, news)
        return news

    @property
    def world(self) -> World | None:
        """The newest tick; None before the first, and without `details`."""
        self._read_details()
        return self._world

    @property
    def beliefs(self) -> dict[str, Belief]:
        """Robot → its newest belief, in its team's frame."""
        self._read_details()
        return self._beliefs

    @property
    def payloads(self) -> dict[str, bytes]:
        """Key → newest valid payload of state, health, world and beliefs, as received."""
        self._read_details()
        return self._payloads

    @property
    def radios(self) -> dict[str, Radio]:
        """Robot → its newest radio message."""
        return {robot: belief.radio for robot, belief in self.beliefs.items()}

    def merge_recorded(self, messages: Iterable[ReceivedMessage]) -> list[GameEvent | GameState]:
        """Merge recorded events and states, of which some were not received; returns the new ones, in their order."""
        fresh: list[GameEvent | GameState] = []
        for received in messages:
            message = valid(received.message)
            if isinstance(message, GameEvent) and message not in self.events:
                self._add_event(message, received)
                fresh.append(message)
            elif isinstance(message, GameState) and (self.state is None or message.tick > self.state.tick):
                self._set_state(message, received)
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
                settled = clock.now() + STATE_SETTLES_S
            clock.sleep_until(clock.now() + POLL_S)
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

    def _follow_details(self) -> _Details:
        bus = self.bus
        worlds, beliefs = bus.subscribe(WORLD, newest=True), bus.subscribe(BELIEF, newest=True)
        return _Details(worlds, beliefs, OrderFollower(bus, self.orders), bus.watch_alive())

    def _update_details(self, details: _Details, news: MatchNews) -> None:
        for presence in iter(details.presences.receive, None):
            if presence.kind is PresenceKind.REFBOX and presence.alive != (presence.name in self.refboxes):
                (self.refboxes.append if presence.alive else self.refboxes.remove)(presence.name)
                news.refboxes_changed = True
        for received in iter(details.worlds.receive, None):
            self._check_host(received, news)
            self._unread[received.key] = received
            news.world = True
        for received in iter(details.beliefs.receive, None):
            self._check_host(received, news)
            self._unread[received.key] = received
            news.beliefs.append(received.key)
        news.orders = details.orders.update()

    def _read_details(self) -> None:
        """Read the newest worlds and beliefs, of which most are replaced before they are used."""
        unread, self._unread = self._unread, {}
        for received in unread.values():
            message = valid(received.message)
            if message is None:
                continue
            self._payloads[received.key] = received.payload
            if isinstance(message, World):
                self._world = message
            else:
                self._beliefs[received.chunks["robot"]] = message

    def _messages(self, subscription: Subscription, news: MatchNews) -> Iterator[tuple[Any, ReceivedMessage]]:
        for received in iter(subscription.receive, None):
            if (message := valid(received.message)) is not None:
                self._check_host(received, news)
                yield message, received

    def _check_host(self, received: ReceivedMessage, news: MatchNews) -> None:
        """With the first message of another host, which counts from 0 again, forget what the host before published.

        A message that is only delivered again, as happens when a link comes back, is older than the newest one.
        """
        stamp, before = received.stamp, self._stamps.get(received.key)
        if stamp is None or (before is not None and stamp.sent_ns <= before.sent_ns):
            return
        is_new = before is not None and stamp.sequence <= before.sequence
        if is_new:
            self._stamps.clear()
        self._stamps[received.key] = stamp
        if not is_new:
            return
        self.host_changes += 1
        self.health = self.first = self.last = self._world = None
        self._newest_tick = 0
        for content in (self.events, self._payloads, self.orders, self._beliefs, self._unread):
            content.clear()
        news.new_host = True
        for messages in (news.events, news.states, news.healths, news.beliefs):
            messages.clear()
        news.world = news.rewound = False

    def _rewind(self, state: GameState, news: MatchNews) -> None:
        """Forget the events that lie ahead again where a replay has jumped back."""
        if state.tick < self._newest_tick - _LATE_TICKS:
            self.events[:] = [event for event in self.events if event.tick <= state.tick]
            self.orders.clear()
            news.rewound = True
        self._newest_tick = state.tick

    def _add_event(self, event: GameEvent, received: ReceivedMessage) -> None:
        self.events.append(event)
        self._note_time(event, received)

    def _set_state(self, state: GameState, received: ReceivedMessage) -> None:
        self.state = state
        self._payloads[received.key] = received.payload
        self._note_time(state, received)

    def _note_time(self, message: GameEvent | GameState | Health, received: ReceivedMessage) -> None:
        if message.tick == 0 or received.stamp is None:
            return
        time = MatchTime(message.tick, message.time, received.stamp.sent_ns)
        if self.first is None or time.tick < self.first.tick:
            self.first = time
        if self.last is None or time.tick >= self.last.tick:
            self.last = time
