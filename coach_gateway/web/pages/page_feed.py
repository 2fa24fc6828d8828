"""What is new of a match as messages of the page: the newest state, health and frame, and every event.

Payloads are validated by the follower. State and health are handed on as they came; the numbers of a frame are rounded,
and it is put together once for all pages that see the same.
"""

from collections.abc import Iterable, Sequence

from coach_gateway.match.debug_follower import DebugFollower
from coach_gateway.match.follower import MatchFollower, MatchNews
from coach_gateway.web.pages.protocol import EventUpdate, OrdersUpdate, RefBoxUpdate, SideOrders
from coach_gateway.web.pages.rounding import rounded_json
from runtime.bus.contract import Bus
from schemas.messages.replay import ReplayTopic
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent
from schemas.messages.world import World
from schemas.side import Side
from schemas.topics import BELIEF, HEALTH, STATE, WORLD
from schemas.wire.part import encode

_EVENTS_KEPT = 2000
"""Events of a match that are sent to a new page, the newest."""


class PageFeed:
    """One match as messages to pages."""

    def __init__(self, bus: Bus) -> None:
        self._match = MatchFollower(bus, details=True)
        self._debug = DebugFollower(bus)
        self._newest: dict[str, str] = {}
        self._events_sent: dict[str, None] = {}
        self._world: World | None = None
        self._roster: tuple[int | str, ...] | None = None
        self._world_text: tuple[World, str] | None = None
        self._beliefs: dict[Side, dict[str, bytes | str]] = {side: {} for side in Side}
        self.setup: Setup | None = None
        """How the match is set up; set by `begin`."""
        self.live = True
        """A match; False for a replay. Set by `begin`."""
        self.topics: Sequence[ReplayTopic] = ()
        """Those of the replay of a file without a match. Set by `begin`."""
        self.host_changed = False
        """A host has come, or other robots take part: the owner queries the host again, and resets this."""
        self.frame_changed = False
        """There is another frame than when the owner last reset this."""
        self.orders_changed = False
        """There is news of orders since the owner last reset this."""

    @property
    def host_present(self) -> bool:
        """The host is present."""
        return self._match.host_present

    def update(self) -> list[str]:
        """Take in what has come, without waiting; returns the messages for all pages, in order."""
        news = self._match.update()
        self._debug.update()
        if news.new_host:
            self._reset()
        messages: list[str] = []
        if news.presence_changed:
            self.host_changed = self.host_changed or self.host_present
            messages.append(self._host())
        if news.refboxes_changed:
            messages.append(self._refbox())
        for event in news.events:
            messages.extend(self._event(event))
        for kind, topic, changed in (("state", STATE, news.states), ("health", HEALTH, news.healths)):
            if changed:
                self._newest[kind] = f'{{"kind":"{kind}","{kind}":{self._match.payloads[topic.key].decode()}}}'
                messages.append(self._newest[kind])
        self._update_frame(news)
        self.orders_changed = self.orders_changed or bool(news.orders) or news.rewound
        return messages

    def begin(
        self,
        setup: Setup | None,
        *,
        live: bool,
        events: Iterable[GameEvent] = (),
        topics: Sequence[ReplayTopic] = (),
    ) -> None:
        """Take in the host's answer to how its match is set up; of a replay, `events` are all of the recording.

        The replay of a file without a match has `topics`, and no setup.
        """
        self.setup, self.live, self.topics = setup, live, topics
        if not live:
            self._events_sent = {_event_text(event): None for event in events}

    def snapshot(self) -> list[str]:
        """What is sent to every page after its welcome, but for orders and the frame."""
        return [self._host(), self._refbox(), *self._newest.values(), *self._events_sent]

    @property
    def has_picture(self) -> bool:
        """A tick has come."""
        return self._world is not None

    def frame(self, beliefs: Iterable[Side], debug: Iterable[Side]) -> str | None:
        """The newest tick with beliefs and drawings of robots of these sides; None before the setup is known."""
        if self._world is None or self.setup is None:
            return None
        tick, time = self._world.tick, round(self._world.time, 3)
        shown = ",".join(text for side in beliefs for text in self._belief_texts(side))
        world, drawn = self._text_of(self._world), self._debug_text(debug)
        return f'{{"kind":"frame","tick":{tick},"time":{time!r},"world":{world},"beliefs":{{{shown}}},"debug":{drawn}}}'

    def orders(self, sides: Iterable[Side]) -> str:
        """The orders of these sides."""
        shown: dict[str, SideOrders] = {}
        for side in sides:
            own, shown[side.value] = self._match.orders.active(side), SideOrders()
            if own is not None:
                orders = SideOrders(order=own.order, acknowledged=own.acknowledged, refused=own.refused)
                shown[side.value] = orders
        return OrdersUpdate(**shown).json()

    def _host(self) -> str:
        return f'{{"kind":"host","there":{"true" if self.host_present else "false"}}}'

    def _refbox(self) -> str:
        connected = self._match.refboxes
        team = Side(connected[0]) if len(connected) == 1 and connected[0] in list(Side) else None
        return RefBoxUpdate(connected=bool(connected), team=team).json()

    def _event(self, event: GameEvent) -> list[str]:
        """The message of an event; none for an event that was sent before: a replay repeats what has happened."""
        text = _event_text(event)
        if text in self._events_sent:
            return []
        self._events_sent[text] = None
        if len(self._events_sent) > _EVENTS_KEPT:
            del self._events_sent[next(iter(self._events_sent))]
        return [text]

    def _update_frame(self, news: MatchNews) -> None:
        """Take in the newest tick and beliefs; one that cannot be read leaves those before."""
        world = self._match.world if news.world else None
        if world is not None and world is not self._world:
            self._watch_roster(world)
            self._world = world
            self.frame_changed = True
        for key in news.beliefs:
            payload, chunks = self._match.payloads.get(key), BELIEF.match(key) or {}
            if payload is not None and chunks["side"] in self._beliefs:
                robot = chunks["robot"]
                self._beliefs[Side(chunks["side"])][robot] = payload

    def _text_of(self, world: World) -> str:
        """The newest tick as JSON, rounded once for all roles."""
        if self._world_text is None or self._world_text[0] is not world:
            self._world_text = world, rounded_json(self._match.payloads[WORLD.key])
        return self._world_text[1]

    def _belief_texts(self, side: Side) -> list[str]:
        """The newest belief of each robot of a side; most are replaced before a frame shows them."""
        beliefs = self._beliefs[side]
        for robot, belief in beliefs.items():
            if isinstance(belief, bytes):
                beliefs[robot] = f'"{robot}":{rounded_json(belief)}'
        return [str(text) for text in beliefs.values()]

    def _debug_text(self, sides: Iterable[Side]) -> str:
        """The drawings of robots of these sides that are shown at this tick, by robot."""
        assert self._world is not None
        drawings = self._debug.shown(self._world.time, sides)
        return rounded_json(encode(drawings)) if drawings else "{}"

    def _watch_roster(self, world: World) -> None:
        """Have the host queried again where a scene or an operator has let other robots take part in a match."""
        roster: tuple[int | str, ...] = (world.episode, *world.robots)
        if self.live and self._roster is not None and roster != self._roster:
            self.host_changed = True
        self._roster = roster

    def _reset(self) -> None:
        """Forget the host before: another one plays."""
        self._newest.clear()
        self._events_sent.clear()
        self._world = self._roster = self.setup = None
        self._debug.clear()
        for texts in self._beliefs.values():
            texts.clear()
        self.host_changed = True


def _event_text(event: GameEvent) -> str:
    return EventUpdate(event=event).json()
