"""A running match for bridges that wait for many things at once: the newest of everything, and word of what changes.

One task follows the bus; questions to the host wait in a thread, and hold up nobody.
"""

import asyncio
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

from coach_gateway.match.host_change import HostChangeDetector
from coach_gateway.match.host_client import HostClient
from coach_gateway.match.host_presence import HostPresence
from coach_gateway.match.orders import OrderFollower
from coach_gateway.service import pause
from schemas.bus.contract import Bus, ReceivedMessage, Subscription
from schemas.errors import TouchlineError
from schemas.game import REFBOX, ActionName, ActionReply, GameEvent, GameState, RefereeAction
from schemas.message import BadMessageError
from schemas.messages.coach import CoachOrder
from schemas.messages.host import Belief, Setup
from schemas.messages.world import World
from schemas.side import Side
from schemas.topics import BELIEF, EVENT, STATE, WORLD

_LOOK_S = 0.01
"""s of wall time between two looks at the bus."""
_ASK_S = 1.0
"""s of wall time until a host that did not answer is asked again how its match is set up."""
_CATCH_UP_S = 1.0
"""s of wall time that a state which was told before an answer may come after it."""
_LATE_TICKS = 50
"""Ticks that a state may be older than one before it; with one that is older still the match has gone back."""
_QUESTIONS = 4
"""At the same time; further ones wait. A stop, and what a league's box says, wait for no others."""
_T = TypeVar("_T")


class LiveMatch:
    """One match, as it stands."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._client = HostClient(bus)
        self._order_clients = {side: HostClient(bus) for side in Side}
        self._states, self._events = bus.subscribe(STATE), bus.subscribe(EVENT, history=True)
        self._worlds = bus.subscribe(WORLD, newest=True)
        self._beliefs = bus.subscribe(BELIEF, newest=True)
        self._watch = bus.watch_alive()
        self._presence = HostPresence(bus)
        self._threads = ThreadPoolExecutor(_QUESTIONS, thread_name_prefix="question")
        self._urgent = ThreadPoolExecutor(_QUESTIONS, thread_name_prefix="urgent")
        self._ordering = {side: asyncio.Lock() for side in Side}
        self._host_change = HostChangeDetector()
        self._ended = False
        self._asked_at = -_ASK_S
        self._asking: asyncio.Task[None] | None = None
        self._stale = True
        self._refboxes: dict[Side, bool] = {}
        self._newest_beliefs: dict[str, ReceivedMessage] = {}
        self._world: ReceivedMessage | None = None
        self.there = False
        """The host is there."""
        self.setup: Setup | None = None
        """How the match is set up; nothing before the host has told."""
        self.sides: dict[str, Side] = {}
        """Robot → its side, of those that take part."""
        self.state: GameState | None = None
        self.events: list[GameEvent] = []
        """All that the host remembers, in order."""
        self.hosts = 0
        """How many have come after the first; events are counted anew with each."""
        self.orders = OrderFollower(bus)
        self.unreadable = 0
        """Messages that could not be read; each was left out."""
        self._state_handlers: list[Callable[[GameState], None]] = []

    async def serve(self, stop: asyncio.Event) -> None:
        """Follow the match until `stop` is set."""
        try:
            while not stop.is_set():
                self.update()
                await pause(stop, _LOOK_S)
        finally:
            self._ended = True
            if self._asking is not None:
                self._asking.cancel()
            for threads in (self._threads, self._urgent):
                threads.shutdown(wait=False, cancel_futures=True)

    def update(self) -> None:
        """Take in what has come, without waiting, and ask for the setup where it is not known or has changed."""
        while (presence := self._watch.receive()) is not None:
            if presence.kind == REFBOX and presence.name in set(Side):
                self._refboxes[Side(presence.name)] = presence.alive
        there = not self._presence.gone() and self._presence.seen
        self._stale = self._stale or (there and not self.there)  # another host may play another match
        self.there = there
        for event in self._messages(self._events):
            self.events.append(event)
        for state in self._messages(self._states):
            self._update_state(state)
        self._world = self._worlds.receive() or self._world
        for received in iter(self._beliefs.receive, None):
            self._newest_beliefs[received.chunks["robot"]] = received
        self.orders.update()
        self._refresh_setup()

    @property
    def now(self) -> float:
        """Wall time in s."""
        return self._bus.clock.now()

    @property
    def world(self) -> World | None:
        """The newest tick; nothing before the first."""
        return self._read(self._world) if self._world is not None else None

    @property
    def time(self) -> float:
        """Simulated time of the newest tick in s; 0 before the first."""
        world = self.world
        return world.time if world is not None else 0.0

    @property
    def refboxes(self) -> list[Side]:
        """The sides whose base stations hear a league's referee box."""
        return [side for side in Side if self._refboxes.get(side, False)]

    def beliefs(self, sides: Iterable[Side]) -> dict[str, Belief]:
        """Robot → what it said last, of these sides, in its team's frame."""
        wanted = list(sides)
        said = {name: self._read(one) for name, one in self._newest_beliefs.items() if self.sides.get(name) in wanted}
        return {name: belief for name, belief in sorted(said.items()) if belief is not None}

    def on_state(self, handle: Callable[[GameState], None]) -> None:
        """Have every state told from now on, in order, beginning with the one that stands."""
        self._state_handlers.append(handle)
        if self.state is not None:
            handle(self.state)

    def connect_refbox(self, side: Side, *, connected: bool) -> None:
        """Tell everybody whether this side's base station hears a referee box: then others may only stop the game."""
        (self._bus.declare_alive if connected else self._bus.withdraw_alive)(REFBOX, side.value)

    async def act(self, action: RefereeAction) -> ActionReply:
        """Ask the referee; without a host the answer is a refusal that says so.

        When it returns, `state` is what the action has led to, so that who asks on decides by no older one.
        """
        urgent = action.action is ActionName.STOP or action.source == REFBOX
        threads = self._urgent if urgent else self._threads
        try:
            reply = await self._in_thread(lambda: self._client.act(action), threads)
        except TouchlineError as error:
            return ActionReply(accepted=False, reason=str(error))
        if reply.tick is not None:
            await self._catch_up(reply.tick)
        return reply

    async def _catch_up(self, tick: int) -> None:
        """Wait for the state of a tick, which the host has told; one that is lost on its way is not waited for long."""
        until = self.now + _CATCH_UP_S
        while (self.state is None or self.state.tick < tick) and self.now < until:
            await asyncio.sleep(_LOOK_S)
            self.update()

    async def order(self, side: Side, **content: Any) -> CoachOrder:
        """Give a side its new standing order; of two, the later one has the larger number. No side waits for the other.

        Raises:
            TouchlineError: no host answers, or the order may not be what it is.
        """
        async with self._ordering[side]:
            return await self._in_thread(lambda: self._order_clients[side].order(side, **content), self._threads)

    async def _in_thread(self, ask: Callable[[], _T], threads: ThreadPoolExecutor) -> _T:
        if self._ended:
            raise TouchlineError("the gateway ends")
        return await asyncio.get_running_loop().run_in_executor(threads, ask)

    def _update_state(self, state: GameState) -> None:
        if self.state is not None and state.tick < self.state.tick - _LATE_TICKS:  # a replay has gone back
            self.events = [event for event in self.events if event.tick <= state.tick]
            self.orders.book.clear()
            self._stale = True
        elif self.state is not None and state.episode != self.state.episode:
            self._stale = True
        self.state = state
        for handle in self._state_handlers:
            handle(state)

    def _refresh_setup(self) -> None:
        """Ask how the match is set up, one question at a time."""
        asking = self._asking is not None and not self._asking.done()
        if self._stale and not asking and self.now >= self._asked_at + _ASK_S:
            self._asked_at = self.now
            self._asking = asyncio.get_running_loop().create_task(self._ask_setup())

    async def _ask_setup(self) -> None:
        self._stale = False  # another host may come before this one has answered
        try:
            setup = await self._in_thread(self._client.setup, self._threads)
        except TouchlineError:
            self._stale = True  # there is no host yet; it is asked again
            return
        self.setup = setup
        self.sides = {name: side for side, team in setup.teams.items() for name in team.robots}

    def _messages(self, subscription: Subscription) -> Iterator[Any]:
        """What has come, message by message: with the first of another host, what was before is forgotten."""
        for received in iter(subscription.receive, None):
            message = self._read(received)
            if message is None:
                continue
            if self._host_change.is_new_host(received):
                self._reset()
            yield message

    def _reset(self) -> None:
        """Another host plays: what the one before has said of events, orders and beliefs no longer counts."""
        self.hosts += 1
        self.events.clear()
        self.orders.book.clear()
        self._newest_beliefs.clear()
        self._stale = True

    def _read(self, received: ReceivedMessage) -> Any:
        try:
            return received.message()
        except BadMessageError:
            self.unreadable += 1
            return None
