"""Serves the page while there is no host yet: pages wait, learn whether their token is right, and command nothing."""

import asyncio
import contextlib
from collections.abc import Callable

from pydantic import ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from coach_gateway.access.client_network import client_network
from coach_gateway.access.roles import Role
from coach_gateway.access.token_checks import TokenChecks
from coach_gateway.web.binding import PageBinding
from coach_gateway.web.connections import Connections, host_check
from coach_gateway.web.door import Door
from coach_gateway.web.pages import Page, Pages
from coach_gateway.web.protocol import (
    MAX_BYTES,
    PAGE_REQUEST,
    Alive,
    HostUpdate,
    PageRequest,
    PageTokenCheck,
    Refusal,
    Reply,
    Welcome,
)
from coach_gateway.web.site import site
from coach_gateway.web.token_gate import TokenGate
from coach_gateway.web.uvicorn_server import web_server
from schemas.process.clock import Clock, WallClock

_ALIVE_S = 0.5
"""s of wall time between two signs of life."""
_CLOSING_S = 1.0
"""s of wall time that closing a connection may take."""
_NO_HOST = "no host plays this match yet"


class WaitingPage:
    """Serves the page before there is a match."""

    def __init__(
        self,
        binding: PageBinding,
        match: str | None,
        clock: Clock | None = None,
        log: Callable[[str], None] = lambda _: None,
    ) -> None:
        """`match` is the name of the match that is waited for; None for any."""
        self._binding, self._match = binding, match
        self._clock = clock or WallClock()
        self.pages = Pages(binding.settings.pages, binding.settings.pages_per_address, log)
        self._gate = TokenGate(TokenChecks(binding.tokens), self.pages, self._clock)
        self._door = Door(self._gate, self.pages)

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set; then pages reconnect by themselves, to the server that serves next."""
        connections = Connections(self.pages.refusals, self._clock)
        server = web_server(site(self._enter, host_check(self._binding.origins, connections)), connections)
        serving = asyncio.create_task(server.serve([self._binding.listener.dup()]))  # it closes its socket
        stopped = asyncio.create_task(stop.wait())
        sweeping = asyncio.create_task(self._sweep())
        try:
            await asyncio.wait([serving, stopped], return_when=asyncio.FIRST_COMPLETED)
        finally:
            server.should_exit = True
            stopped.cancel()
            sweeping.cancel()
            await serving

    async def _enter(self, socket: WebSocket) -> None:
        """Serve one page from its connection to its end."""
        origin, host = socket.headers.get("origin"), socket.headers.get("host")
        network = client_network(socket.client.host if socket.client is not None else None)
        if not self._binding.origins.allows(origin, host):
            self.pages.refusals.note("foreign", network, self._clock.now(), f"origin {origin}")
            await socket.close(1008)
            return
        if not self.pages.may_open(network, self._clock.now()):
            await socket.close(1013)
            return
        await socket.accept()
        page = Page(origin, host, self._clock.now(), network)
        with contextlib.suppress(WebSocketDisconnect, RuntimeError, TimeoutError):  # the page leaves, or reads nothing
            first: str | None = None
            if why := self.pages.why_no_room(network):
                first = await self._door.first_message(socket, page)
                if first is None:
                    self.pages.refusals.note("full", network, self._clock.now())
                    await _refuse(socket, why)
                    return
            self.pages.enter(page)
            try:
                await self._serve_page(socket, page, first)
            finally:
                self.pages.forget(page)

    async def _serve_page(self, socket: WebSocket, page: Page, first: str | None) -> None:
        """Welcome a page and answer its requests until it leaves, or is disconnected."""
        self._welcome(page)
        if first is not None:
            self._answer(page, first)
        works = (self._send(socket, page), self._read(socket, page), page.leave.wait())
        tasks = [asyncio.ensure_future(work) for work in works]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
        if page.close_reason:
            await _refuse(socket, page.close_reason)

    async def _send(self, socket: WebSocket, page: Page) -> None:
        """Send what waits, as fast as the page reads."""
        while True:
            text = await page.queue.next()
            page.sending_since = self._clock.now()
            await socket.send_text(text)
            page.sending_since = None

    async def _sweep(self) -> None:
        """Drop pages that do not read, and send a sign of life to the others."""
        alive = Alive().model_dump_json()
        while True:
            self.pages.drop_stuck(self._clock.now())
            self.pages.send(alive)
            await asyncio.sleep(_ALIVE_S)

    def _welcome(self, page: Page) -> None:
        welcome = Welcome(role=page.role, match=self._match, setup=None, live=True, deeds=[], beliefs=[], orders=[])
        page.queue.restart(welcome.model_dump_json())
        page.queue.put(HostUpdate(there=False).model_dump_json())

    async def _read(self, socket: WebSocket, page: Page) -> None:
        """Answer the page's messages until it leaves."""
        while (message := await socket.receive())["type"] != "websocket.disconnect":
            text = message.get("text")
            if not page.rate_limit.allow(self._clock.now()):
                self._note_bad(page, "too much")
            elif text is None or len(text) > MAX_BYTES:
                self._note_bad(page, "bad")
            else:
                self._answer(page, text)

    def _note_bad(self, page: Page, kind: str) -> None:
        self.pages.refusals.note(kind, page.network, self._clock.now())
        page.note_bad()

    def _answer(self, page: Page, text: str) -> None:
        """Check the token of a request; no request but that check can be carried out before there is a host."""
        try:
            request = PAGE_REQUEST.validate_json(text)
        except ValidationError:
            self._note_bad(page, "bad")
            return
        self._gate.check(page, request, self._carry_out)

    def _carry_out(self, page: Page, role: Role, request: PageRequest) -> None:
        is_check = isinstance(request, PageTokenCheck)
        reply = Reply(id=request.id, accepted=is_check, reason="" if is_check else _NO_HOST)
        page.queue.put(reply.model_dump_json())
        if is_check and role is not page.role:
            page.role = role
            self._welcome(page)


async def _refuse(socket: WebSocket, why: str) -> None:
    async with asyncio.timeout(_CLOSING_S):
        await socket.send_text(Refusal(reason=why).model_dump_json())
        await socket.close(1008, why)
