"""Carries out the requests of pages that their roles allow: queries to the host or a replay, orders, manual control."""

import asyncio
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

from coach_gateway.access import rights
from coach_gateway.access.roles import TokenRole
from coach_gateway.match.host_client import HostClient
from coach_gateway.web.pages.protocol import (
    PageAction,
    PageDrive,
    PageOrder,
    PageParameters,
    PageReplay,
    PageRequest,
    PageScene,
    PageSeat,
    Reply,
)
from runtime.bus.contract import Bus, Publisher
from schemas.errors import TouchlineError
from schemas.messages.parameters import ParameterOperation
from schemas.side import Side
from schemas.soccer.game import ActionName
from schemas.topics import MANUAL, PARAMETERS, REPLAY_CONTROL, SCENE
from schemas.wire.message import Message

SOURCES = {TokenRole.REFEREE: "referee's page", TokenRole.CYAN: "cyan's page", TokenRole.MAGENTA: "magenta's page"}
"""Role → the source that the match records for a request."""

_THREADS = 4
"""Requests of one role, or stops, that are in progress at the same time; further ones wait."""
_IN_EVERY_REPLY = frozenset({"version", "accepted", "reason"})


class RequestHandler:
    """Takes requests of pages to the match."""

    def __init__(self, bus: Bus) -> None:
        self.client = HostClient(bus)
        self._bus = bus
        self._manual: dict[str, Publisher] = {}
        self._order_clients = {side: HostClient(bus) for side in Side}
        self._ordering = {side: asyncio.Lock() for side in Side}
        self._threads = {role: ThreadPoolExecutor(_THREADS, thread_name_prefix=role.value) for role in TokenRole}
        self._stops = ThreadPoolExecutor(_THREADS, thread_name_prefix="stop")

    async def answer(self, role: TokenRole, request: PageRequest) -> Reply:
        """Send a request to the match and return its reply.

        Requests of one role do not wait for another's, orders of one side not for the other's, and a stop
        waits for nothing.
        """
        try:
            if isinstance(request, PageOrder):
                order_of = partial(self._order_clients[request.side].order, request.side)
                async with self._ordering[request.side]:  # of two orders the later one has the larger number
                    order = await _in_thread(self._threads[role], partial(order_of, **request.order.content()))
                return Reply(id=request.id, accepted=True, answer=_content(order))
            threads = self._stops if is_stop(request) else self._threads[role]
            reply = await _in_thread(threads, self._query(role, request))
        except TouchlineError as error:
            return Reply(id=request.id, accepted=False, reason=str(error))
        return Reply(id=request.id, accepted=reply.accepted, reason=reply.reason, answer=_content(reply))

    def drive(self, request: PageDrive) -> None:
        """Send a drive to a robot, without waiting."""
        if request.robot not in self._manual:
            self._manual[request.robot] = self._bus.publisher(MANUAL, robot=request.robot)
        self._manual[request.robot].put(request.manual)

    def _query(self, role: TokenRole, request: PageRequest) -> Callable[[], Any]:
        """The query of a request; it blocks until the reply."""
        source = {"source": SOURCES.get(role, role.value)}
        match request:
            case PageAction():
                return partial(self.client.act, request.action.replace(**source, referee=None))
            case PageScene() | PageParameters():
                topic = SCENE if isinstance(request, PageScene) else PARAMETERS
                return partial(self.client.ask, topic, request.request.replace(**source))
            case PageReplay():
                return partial(self.client.ask, REPLAY_CONTROL, request.request)
            case PageSeat():
                return partial(self.client.referee_seat, request.operation, **source)
        raise TypeError(f"{request.deed} is not a query to the match")


def refusal(role: TokenRole, request: PageRequest, robots: Mapping[str, Side]) -> str | None:
    """Why a role may not ask for this; None when it may. `robots` are all robots of the match with their sides."""
    match request:
        case PageAction():
            action = request.action
            return rights.refusal(role, action.action.value, robots, robot=action.robot)
        case PageOrder():
            return rights.refusal(role, "order", robots, side=request.side)
        case PageDrive():
            return rights.refusal(role, "drive", robots, robot=request.robot)
        case PageParameters():
            changes = request.request.operation in (ParameterOperation.SET, ParameterOperation.RESET)
            return rights.refusal(role, "parameters" if changes else "read_parameters", robots)
    return rights.refusal(role, request.deed, robots)


def is_stop(request: PageRequest) -> bool:
    """Whether a request stops the game."""
    return isinstance(request, PageAction) and request.action.action is ActionName.STOP


async def _in_thread(threads: ThreadPoolExecutor, request: Callable[[], Any]) -> Any:
    return await asyncio.get_running_loop().run_in_executor(threads, request)


def _content(reply: Message) -> dict[str, Any] | None:
    """The fields of a reply besides `accepted` and `reason`."""
    return {name: value for name, value in reply.plain().items() if name not in _IN_EVERY_REPLY} or None
