"""Carries out what a page asks for and its role allows: asks host or replay, gives orders, drives robots."""

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from coach_gateway.gateway import Gateway
from coach_gateway.web.protocol import (
    Ask,
    AskAction,
    AskDrive,
    AskOrder,
    AskParameters,
    AskReplay,
    AskScene,
    Reply,
    Role,
)
from schemas.bus.contract import Bus, Publisher
from schemas.coach import CoachOrder
from schemas.errors import TouchlineError
from schemas.game import ActionName
from schemas.message import Message
from schemas.side import Side
from schemas.topics import HAND

SOURCES = {Role.REFEREE: "referee's page", Role.CYAN: "cyan's page", Role.MAGENTA: "magenta's page"}
"""How the match names who asked."""

_THREADS = 4
"""Questions of one role, or stops, that are on their way at once; further ones wait."""
_SAID_ANYWAY = frozenset({"version", "accepted", "reason"})


class Desk:
    """Takes what pages ask to the match."""

    def __init__(self, bus: Bus) -> None:
        self.gateway = Gateway(bus)
        self._bus = bus
        self._hands: dict[str, Publisher] = {}
        self._benches = {side: Gateway(bus) for side in Side}
        self._numbering = {side: asyncio.Lock() for side in Side}
        self._threads = {role: ThreadPoolExecutor(_THREADS, thread_name_prefix=role.value) for role in Role}
        self._stops = ThreadPoolExecutor(_THREADS, thread_name_prefix="stop")

    async def answer(self, role: Role, ask: Ask) -> Reply:
        """Ask the match, and say what came of it; questions of one role wait for no other's, orders of one side
        for none of the other's, and a stop for nothing at all."""
        try:
            match ask:
                case AskOrder():
                    async with self._numbering[ask.side]:  # of two orders the later one has the larger number
                        order = await _in_thread(self._threads[role], lambda: self._order(ask))
                    return _accepted(ask, order)
                case _:
                    threads = self._stops if is_stop(ask) else self._threads[role]
                    said = await _in_thread(threads, self._question(role, ask))
        except TouchlineError as error:
            return Reply(id=ask.id, accepted=False, reason=str(error))
        return Reply(id=ask.id, accepted=said.accepted, reason=said.reason, answer=_content(said))

    def drive(self, ask: AskDrive) -> None:
        """Have a person drive a robot; sent, and not waited for."""
        if ask.robot not in self._hands:
            self._hands[ask.robot] = self._bus.publisher(HAND, robot=ask.robot)
        self._hands[ask.robot].put(ask.hand)

    def _question(self, role: Role, ask: Ask) -> Callable[[], Any]:
        """What to ask the match; takes as long as the answer."""
        source = {"source": SOURCES.get(role, role.value)}
        match ask:
            case AskAction():
                action = ask.action.model_copy(update=source)
                return lambda: self.gateway.act(action)
            case AskScene():
                scene = ask.request.model_copy(update=source)
                return lambda: self.gateway.scene(scene)
            case AskParameters():
                parameters = ask.request.model_copy(update=source)
                return lambda: self.gateway.parameters(parameters)
            case AskReplay():
                replay = ask.request
                return lambda: self.gateway.replay(replay)
        raise TypeError(f"{ask.deed} is no question to the match")

    def _order(self, ask: AskOrder) -> CoachOrder:
        content = ask.order.model_dump(exclude={"version", "sequence"}, exclude_unset=True)
        return self._benches[ask.side].order(ask.side, **content)


def is_stop(ask: Ask) -> bool:
    """Whether the game is to be stopped."""
    return isinstance(ask, AskAction) and ask.action.action is ActionName.STOP


async def _in_thread(threads: ThreadPoolExecutor, ask: Callable[[], Any]) -> Any:
    return await asyncio.get_running_loop().run_in_executor(threads, ask)


def _accepted(ask: Ask, order: CoachOrder) -> Reply:
    return Reply(id=ask.id, accepted=True, answer=order.model_dump(mode="json", exclude={"version"}))


def _content(said: Message) -> dict[str, Any] | None:
    """What was said beside yes or no."""
    return said.model_dump(mode="json", exclude=set(_SAID_ANYWAY)) or None
