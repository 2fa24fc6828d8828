"""Serves the page while there is no host yet: pages wait, learn whether their token is right, and command nothing."""

import asyncio
import contextlib

from pydantic import ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from coach_gateway.access.client_network import client_network
from coach_gateway.access.tokens import UNKNOWN_TOKEN
from coach_gateway.web.binding import PageBinding
from coach_gateway.web.pages import Page, Pages
from coach_gateway.web.protocol import (
    MAX_BYTES,
    PAGE_REQUEST,
    Alive,
    HostUpdate,
    PageTokenCheck,
    Refusal,
    Reply,
    Welcome,
)
from coach_gateway.web.site import site
from coach_gateway.web.uvicorn_server import web_server
from schemas.process.clock import Clock, WallClock

_ALIVE_S = 0.5
"""s of wall time between two signs of life."""
_NO_HOST = "no host plays this match yet"


class WaitingPage:
    """Serves the page before there is a match."""

    def __init__(self, binding: PageBinding, match: str | None, clock: Clock | None = None) -> None:
        """`match` is the name of the match that is waited for; None for any."""
        self._binding, self._match = binding, match
        self._clock = clock or WallClock()
        self._pages = Pages(binding.settings.pages, binding.settings.pages_per_address)

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set; then pages reconnect by themselves, to the server that serves next."""
        server = web_server(site(self._enter), self._binding.settings.pages)
        serving = asyncio.create_task(server.serve([self._binding.listener.dup()]))  # it closes its socket
        stopped = asyncio.create_task(stop.wait())
        try:
            await asyncio.wait([serving, stopped], return_when=asyncio.FIRST_COMPLETED)
        finally:
            server.should_exit = True
            stopped.cancel()
            await serving

    async def _enter(self, socket: WebSocket) -> None:
        """Serve one page from its connection to its end."""
        origin, host = socket.headers.get("origin"), socket.headers.get("host")
        if not self._binding.origins.allows(origin, host):
            await socket.close(1008)
            return
        await socket.accept()
        network = client_network(socket.client.host if socket.client is not None else None)
        page = Page(origin, host, self._clock.now(), network)
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # the page leaves while something is sent to it
            if why := self._pages.why_no_room(network):
                await _refuse(socket, why)
                return
            self._pages.enter(page)
            try:
                await self._serve_page(socket, page)
            finally:
                self._pages.forget(page)

    async def _serve_page(self, socket: WebSocket, page: Page) -> None:
        """Welcome a page and answer its requests until it leaves, or is disconnected for too many bad ones."""
        self._welcome(page)
        reading = asyncio.create_task(self._read(socket, page))
        try:
            while not reading.done() and not page.leave.is_set():
                with contextlib.suppress(TimeoutError):
                    async with asyncio.timeout(_ALIVE_S):
                        await socket.send_text(await page.queue.next())
                        continue
                await socket.send_text(Alive().model_dump_json())
            if page.close_reason:
                await _refuse(socket, page.close_reason)
        finally:
            reading.cancel()
            await asyncio.gather(reading, return_exceptions=True)

    def _welcome(self, page: Page) -> None:
        welcome = Welcome(role=page.role, match=self._match, setup=None, live=True, deeds=[], beliefs=[], orders=[])
        page.queue.restart(welcome.model_dump_json())
        page.queue.put(HostUpdate(there=False).model_dump_json())

    async def _read(self, socket: WebSocket, page: Page) -> None:
        """Answer the page's messages until it leaves."""
        while (message := await socket.receive())["type"] != "websocket.disconnect":
            text = message.get("text")
            if not page.rate_limit.allow(self._clock.now()) or text is None or len(text) > MAX_BYTES:
                page.note_bad()
                continue
            self._answer(page, text)

    def _answer(self, page: Page, text: str) -> None:
        """Check the token of a request; no request but that check can be carried out before there is a host."""
        try:
            request = PAGE_REQUEST.validate_json(text)
        except ValidationError:
            page.note_bad()
            return
        role = self._binding.tokens.role_of(request.token)
        if role is None:
            page.note_wrong_token()
            reply = Reply(id=request.id, accepted=False, reason=UNKNOWN_TOKEN)
        elif isinstance(request, PageTokenCheck):
            reply = Reply(id=request.id, accepted=True)
        else:
            reply = Reply(id=request.id, accepted=False, reason=_NO_HOST)
        page.queue.put(reply.model_dump_json())
        if role is not None and isinstance(request, PageTokenCheck) and role is not page.role:
            page.role = role
            self._welcome(page)


async def _refuse(socket: WebSocket, why: str) -> None:
    await socket.send_text(Refusal(reason=why).model_dump_json())
    await socket.close(1008, why)
