"""What the page is told of a match, as the bus brings it: the newest of what stands, and every event.

Payloads are validated here and handed on as they came, so that a frame is put together once for all pages.
"""

from collections.abc import Iterable
from typing import Any

from coach_gateway.match.host_change import HostChangeDetector
from coach_gateway.match.orders import OrderFollower
from coach_gateway.web.protocol import EventUpdate, OrdersUpdate, RefBoxUpdate, SideOrders
from schemas.bus.contract import Bus, PresenceKind, ReceivedMessage, Subscription
from schemas.bus.host_watch import HostWatch
from schemas.game import GameEvent
from schemas.message import BadMessageError
from schemas.messages.host import Setup
from schemas.messages.world import World
from schemas.side import Side
from schemas.topics import BELIEF, EVENT, HEALTH, STATE, WORLD

_EVENTS_KEPT = 2000
"""Events of a match that a page is told of, the newest."""


class PageFeed:
    """Follows one match, and knows how it stands."""

    def __init__(self, bus: Bus) -> None:
        self._events = bus.subscribe(EVENT, history=True)
        self._latched: tuple[tuple[str, Subscription], ...] = (
            ("state", bus.subscribe(STATE, newest=True)),
            ("health", bus.subscribe(HEALTH, newest=True)),
        )
        self._worlds = bus.subscribe(WORLD, newest=True)
        self._belief_subscription = bus.subscribe(BELIEF, newest=True)
        self._orders = OrderFollower(bus)
        self._presence = HostWatch(bus)
        self._others = bus.watch_alive()
        self._refboxes: dict[str, bool] = {}
        self._host_change = HostChangeDetector()
        self._newest: dict[str, str] = {}
        self._events_sent: dict[str, None] = {}
        self._world: tuple[str, str] | None = None
        self._roster: tuple[int | str, ...] | None = None
        self._beliefs: dict[Side, dict[str, str]] = {side: {} for side in Side}
        self.setup: Setup | None = None
        """How the match is set up, as whoever owns this has asked."""
        self.live = True
        """A match; otherwise a replay, as whoever owns this has found."""
        self.there = False
        """The host is there."""
        self.host_changed = False
        """A host has come, or others take part: whoever owns this asks it anew, and then says that it is no news."""
        self.frame_changed = False
        """There is another frame than when this was last set back."""
        self.orders_changed = False
        """There is news of orders, likewise."""
        self.unreadable = 0
        """Messages that could not be read; each was left out."""

    def update(self) -> list[str]:
        """Take in what has come, without waiting; returns what all pages are to be told, in order."""
        news: list[str] = []
        there = not self._presence.has_left() and self._presence.seen
        if there != self.there:
            self.there = there
            self.host_changed = self.host_changed or there
            news.append(self._host())
        if self._look_for_refboxes():
            news.append(self._refbox())
        for received in _all(self._events):
            news.extend(self._event(received))
        for kind, subscription in self._latched:
            for payload in self._payloads(subscription):
                self._newest[kind] = f'{{"kind":"{kind}","{kind}":{payload}}}'
                news.append(self._newest[kind])
        self._update_frame()
        self.orders_changed = bool(self._orders.update()) or self.orders_changed
        return news

    def begin(self, setup: Setup | None, *, live: bool, events: Iterable[GameEvent] = ()) -> None:
        """A host was asked how its match is set up; of a replay, `events` are all of the recording."""
        self.setup, self.live = setup, live
        if not live:
            self._events_sent = {_event_text(event): None for event in events}

    def snapshot(self) -> list[str]:
        """What every page is told after its welcome, but for orders and the frame."""
        return [self._host(), self._refbox(), *self._newest.values(), *self._events_sent]

    @property
    def has_picture(self) -> bool:
        """A tick has come."""
        return self._world is not None

    def frame(self, beliefs: Iterable[Side]) -> str | None:
        """The newest tick with what robots of these sides believe; nothing before it is known what is played."""
        if self._world is None or self.setup is None:
            return None
        head, world = self._world
        words = ",".join(text for side in beliefs for text in self._beliefs[side].values())
        return f'{{"kind":"frame",{head},"world":{world},"beliefs":{{{words}}}}}'

    def orders(self, sides: Iterable[Side]) -> str:
        """The orders of these sides."""
        shown: dict[str, SideOrders] = {}
        for side in sides:
            active = self._orders.book.active(side)
            known = SideOrders(order=active.order, acknowledged=active.acknowledged) if active else SideOrders()
            shown[side.value] = known
        return OrdersUpdate.model_validate(shown).model_dump_json()

    def _host(self) -> str:
        return f'{{"kind":"host","there":{"true" if self.there else "false"}}}'

    def _look_for_refboxes(self) -> bool:
        """Whether a base station has come to a league's referee box, or gone."""
        before = dict(self._refboxes)
        while (presence := self._others.receive()) is not None:
            if presence.kind is PresenceKind.REFBOX:
                self._refboxes[presence.name] = presence.alive
        return self._refboxes != before

    def _refbox(self) -> str:
        there = [name for name, alive in self._refboxes.items() if alive]
        team = Side(there[0]) if len(there) == 1 and there[0] in list(Side) else None
        return RefBoxUpdate(connected=bool(there), team=team).model_dump_json()

    def _event(self, received: ReceivedMessage) -> list[str]:
        """What to say of an event; nothing of one that was told: a replay says again what has happened."""
        event = self._read(received)
        if event is None or (text := _event_text(event)) in self._events_sent:
            return []
        self._events_sent[text] = None
        if len(self._events_sent) > _EVENTS_KEPT:
            del self._events_sent[next(iter(self._events_sent))]
        return [text]

    def _update_frame(self) -> None:
        for received in _all(self._worlds):
            world = self._read(received)
            if world is not None:
                self._watch_roster(world)
                self._world = f'"tick":{world.tick},"time":{world.time!r}', received.payload.decode()
                self.frame_changed = True
        for received in _all(self._belief_subscription):
            belief = self._read(received)
            side = received.chunks["side"]
            if belief is not None and side in self._beliefs:
                robot = received.chunks["robot"]
                self._beliefs[Side(side)][robot] = f'"{robot}":{received.payload.decode()}'

    def _watch_roster(self, world: World) -> None:
        """In a match, a scene or an operator may let others take part: then the host is asked again who does."""
        roster: tuple[int | str, ...] = (world.episode, *world.robots)
        if self.live and self._roster is not None and roster != self._roster:
            self.host_changed = True
        self._roster = roster

    def _payloads(self, subscription: Subscription) -> list[str]:
        return [received.payload.decode() for received in _all(subscription) if self._read(received) is not None]

    def _read(self, received: ReceivedMessage) -> Any:
        """The valid message; nothing when it is none. Of another host's, it is the first that counts."""
        try:
            message = received.message()
        except BadMessageError:
            self.unreadable += 1
            return None
        if self._host_change.is_new_host(received):
            self._reset()
        return message

    def _reset(self) -> None:
        """Another host plays: nothing of the one before counts."""
        self._newest.clear()
        self._events_sent.clear()
        self._world = self._roster = self.setup = None
        for words in self._beliefs.values():
            words.clear()
        self._orders.book.clear()
        self.host_changed = True


def _event_text(event: GameEvent) -> str:
    return EventUpdate(event=event).model_dump_json()


def _all(subscription: Subscription) -> Iterable[ReceivedMessage]:
    return iter(subscription.receive, None)
