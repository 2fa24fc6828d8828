"""A running match for bridges, which are asynchronous: follows it, and sends requests to its host.

One task follows the bus. Requests to the host wait in threads, so that they delay nothing else.
"""

import asyncio
from collections.abc import Callable, Collection
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.host_client import HostClient
from coach_gateway.match.team_obstacles import TeamObstacle, team_obstacles
from coach_gateway.service import pause
from coach_gateway.timing import CATCH_UP_S, HOST_RETRY_S, POLL_S
from runtime.bus.contract import Bus, PresenceKind
from schemas.errors import TouchlineError
from schemas.messages.coach import CoachOrder
from schemas.messages.radio import Belief
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import ActionReply, GameState, RefereeAction
from schemas.messages.world import World
from schemas.natural_order import natural_order
from schemas.side import Side
from schemas.soccer.game import REFBOX, ActionName

_REQUESTS = 4
"""Requests at the same time; further ones wait. A stop, and what a league's box commands, wait for no others."""
_T = TypeVar("_T")


class LiveMatch:
    """The present state of one match."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self.follower = MatchFollower(bus, details=True)
        self._client = HostClient(bus)
        self._order_clients = {side: HostClient(bus) for side in Side}
        self._threads = ThreadPoolExecutor(_REQUESTS, thread_name_prefix="request")
        self._urgent = ThreadPoolExecutor(_REQUESTS, thread_name_prefix="urgent")
        self._ordering = {side: asyncio.Lock() for side in Side}
        self._ended = False
        self._asked_at = -HOST_RETRY_S
        self._asking: asyncio.Task[None] | None = None
        self._stale = True
        self.setup: Setup | None = None
        """The setup of the match; None before the host has replied."""
        self.sides: dict[str, Side] = {}
        """Robot → its side, of those that take part."""
        self._state_handlers: list[Callable[[GameState], None]] = []

    async def serve(self, stop: asyncio.Event) -> None:
        """Follow the match until `stop` is set."""
        try:
            while not stop.is_set():
                self.update()
                await pause(stop, POLL_S)
        finally:
            self._ended = True
            if self._asking is not None:
                self._asking.cancel()
            for threads in (self._threads, self._urgent):
                threads.shutdown(wait=False, cancel_futures=True)

    def update(self) -> None:
        """Process received messages, without waiting; query the setup where it is not known or has changed."""
        episode = self.state.episode if self.state is not None else None
        news = self.follower.update()
        came = news.presence_changed and self.follower.host_present  # another host may play another match
        if came or news.new_host or news.rewound:
            self._stale = True
        for state in news.states:
            self._stale = self._stale or episode not in (None, state.episode)
            episode = state.episode
            for handle in self._state_handlers:
                handle(state)
        self._refresh_setup()

    @property
    def now(self) -> float:
        """Wall time in s."""
        return self._bus.clock.now()

    @property
    def state(self) -> GameState | None:
        """The newest state of the game; None before the first."""
        return self.follower.state

    @property
    def world(self) -> World | None:
        """The newest tick; None before the first."""
        return self.follower.world

    @property
    def time(self) -> float:
        """Simulated time of the newest tick in s; 0 before the first."""
        world = self.world
        return world.time if world is not None else 0.0

    @property
    def refboxes(self) -> list[Side]:
        """The sides whose base stations are connected to a league's referee box."""
        return [side for side in Side if side.value in self.follower.refboxes]

    def beliefs(self, sides: Collection[Side]) -> dict[str, Belief]:
        """Robot → its newest belief, of these sides, in its team's frame."""
        beliefs = self.follower.beliefs
        return {name: beliefs[name] for name in sorted(beliefs, key=natural_order) if self.sides.get(name) in sides}

    def obstacles(self, side: Side) -> list[TeamObstacle]:
        """Opponents and other bodies as this side believes them, in its team frame."""
        return team_obstacles(self.beliefs([side]), self.time)

    def on_state(self, handle: Callable[[GameState], None]) -> None:
        """Call `handle` with every state from now on, in order, beginning with the newest one."""
        self._state_handlers.append(handle)
        if self.state is not None:
            handle(self.state)

    def connect_refbox(self, side: Side, *, connected: bool) -> None:
        """Declare on the bus whether this side's base station is connected to a referee box.

        Meanwhile other clients may only stop the game.
        """
        (self._bus.declare_alive if connected else self._bus.withdraw_alive)(PresenceKind.REFBOX, side.value)

    async def act(self, action: RefereeAction) -> ActionReply:
        """Request an action from the referee; without a host the reply is a refusal with that reason.

        When it returns, `state` is at least as new as the action: the next request never rests on an older state.
        """
        try:
            return await self.act_in_time(action)
        except TouchlineError as error:
            return ActionReply(accepted=False, reason=str(error))

    async def act_in_time(self, action: RefereeAction, patience: float | None = None) -> ActionReply:
        """As `act`, for a caller that repeats what no host has answered within `patience` s of wall time.

        Raises:
            TouchlineError: no reply.
        """
        urgent = action.action is ActionName.STOP or action.source == REFBOX
        threads = self._urgent if urgent else self._threads
        reply = await self._in_thread(lambda: self._client.act(action, patience), threads)
        if reply.tick is not None:
            await self._catch_up(reply.tick)
        return reply

    async def _catch_up(self, tick: int) -> None:
        """Wait for the state of a tick that the host has published, for a limited time in case it was lost."""
        until = self.now + CATCH_UP_S
        while (self.state is None or self.state.tick < tick) and self.now < until:
            await asyncio.sleep(POLL_S)
            self.update()

    async def order(self, side: Side, **content: Any) -> CoachOrder:
        """Send a side its new order; of two orders the later has the larger number. No side waits for the other.

        Raises:
            TouchlineError: no host answers, or the order is invalid.
        """
        async with self._ordering[side]:
            return await self._in_thread(lambda: self._order_clients[side].order(side, **content), self._threads)

    async def _in_thread(self, ask: Callable[[], _T], threads: ThreadPoolExecutor) -> _T:
        if self._ended:
            raise TouchlineError("the gateway is shutting down")
        return await asyncio.get_running_loop().run_in_executor(threads, ask)

    def _refresh_setup(self) -> None:
        """Query the setup, one query at a time."""
        asking = self._asking is not None and not self._asking.done()
        if self._stale and not asking and self.now >= self._asked_at + HOST_RETRY_S:
            self._asked_at = self.now
            self._asking = asyncio.get_running_loop().create_task(self._ask_setup())

    async def _ask_setup(self) -> None:
        self._stale = False  # another host may join before this one replies
        try:
            setup = await self._in_thread(self._client.setup, self._threads)
        except TouchlineError:
            self._stale = True  # there is no host yet; the query is repeated
            return
        self.setup = setup
        self.sides = setup.sides
