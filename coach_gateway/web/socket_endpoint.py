"""The WebSocket endpoint: admits pages, reads their messages, disconnects them. One page never harms another."""

import asyncio
import contextlib

from pydantic import ValidationError
from pydantic_core import from_json
from starlette.websockets import WebSocket, WebSocketDisconnect

from coach_gateway.access.client_network import client_network
from coach_gateway.access.origins import Origins
from coach_gateway.access.roles import Role
from coach_gateway.web.broadcaster import PageBroadcaster
from coach_gateway.web.door import Door
from coach_gateway.web.manual_control import ManualControl
from coach_gateway.web.pages import TOO_LONG_WEIGHT, Page, Pages
from coach_gateway.web.protocol import (
    MAX_BYTES,
    PAGE_REQUEST,
    PageDrive,
    PageRequest,
    PageTokenCheck,
    Refusal,
    Reply,
    fault_sentence,
)
from coach_gateway.web.requests import RequestHandler, is_stop, refusal
from coach_gateway.web.token_gate import TokenGate
from schemas.process.clock import Clock

_MOST_PENDING = 8
"""Requests of one page that may wait for their replies."""
_POLICY, _TRY_AGAIN = 1008, 1013
"""WebSocket close codes: policy violation, and try again later."""
_CLOSING_S = 1.0
"""s of wall time that closing a connection may take."""


class SocketEndpoint:
    """Serves the WebSockets of all pages."""

    def __init__(
        self,
        broadcaster: PageBroadcaster,
        pages: Pages,
        requests: RequestHandler,
        gate: TokenGate,
        origins: Origins,
        clock: Clock,
    ) -> None:
        self._broadcaster, self._pages, self._requests = broadcaster, pages, requests
        self._gate, self._origins, self._clock = gate, origins, clock
        self._door = Door(gate, pages)
        self._manual_control = ManualControl()

    async def enter(self, socket: WebSocket) -> None:
        """Serve one page from its connection to its end."""
        origin, host = socket.headers.get("origin"), socket.headers.get("host")
        network = client_network(socket.client.host if socket.client is not None else None)
        if not self._origins.allows(origin, host):
            self._pages.refusals.note("foreign", network, self._clock.now(), f"origin {origin}")
            await socket.close(_POLICY)  # before it is accepted: HTTP 403
            return
        if not self._pages.may_open(network, self._clock.now()):
            await socket.close(_TRY_AGAIN)
            return
        await socket.accept()
        page = Page(origin, host, self._clock.now(), network)
        first: str | None = None
        if why := self._pages.why_no_room(network):
            first = await self._door.first_message(socket, page)
            if first is None:
                self._pages.refusals.note("full", network, self._clock.now())
                await _close(socket, why, _TRY_AGAIN)
                return
        self._pages.enter(page)
        self._broadcaster.welcome(page)
        if first is not None:
            self._read_text(page, first)
        try:
            await self._run(socket, page)
        finally:
            self._pages.forget(page)

    async def _run(self, socket: WebSocket, page: Page) -> None:
        """Serve a page until either side leaves."""
        works = (self._send(socket, page), self._read(socket, page), _leaves(page))
        tasks = [asyncio.create_task(work) for work in works]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in tasks:
                task.cancel()
            ends = await asyncio.gather(*tasks, return_exceptions=True)
        for end in ends:
            if isinstance(end, Exception) and not isinstance(end, WebSocketDisconnect):
                raise end  # an error of the server ends this page alone, and is logged
        if page.close_reason:
            await _close(socket, page.close_reason, _POLICY)

    async def _send(self, socket: WebSocket, page: Page) -> None:
        """Send what waits, as fast as the page reads; everything else that is due takes a turn after each message."""
        while True:
            text = await page.queue.next()
            page.sending_since = self._clock.now()
            await socket.send({"type": "websocket.send", "text": text})
            page.sending_since = None
            await asyncio.sleep(0)

    async def _read(self, socket: WebSocket, page: Page) -> None:
        """Read the page's messages until it leaves."""
        while True:
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            if not page.rate_limit.allow(self._clock.now()):
                self._reject_excess(page)
                continue
            self._read_text(page, message.get("text"))

    def _read_text(self, page: Page, text: str | None) -> None:
        request = self._parsed(page, text)
        if request is not None:
            self._gate.check(page, request, self._handle)

    def _reject_excess(self, page: Page) -> None:
        self._pages.refusals.note("too much", page.network, self._clock.now())
        page.note_bad()
        if page.rate_limit_notice.allow(self._clock.now()):
            _reply(page, Reply(id=None, accepted=False, reason="too many messages; send them more slowly"))

    def _parsed(self, page: Page, text: str | None) -> PageRequest | None:
        """The request of a message; None for one that cannot be read, which is counted and replied to."""
        number: int | None = None
        if text is None:
            why = "only text messages are read"
        elif len(text) > MAX_BYTES:
            why = f"a message of {len(text)} characters is too long; at most {MAX_BYTES} are read"
        else:
            try:
                return PAGE_REQUEST.validate_json(text)
            except ValidationError as error:
                number, why = _number(text), fault_sentence(error)
        self._pages.refusals.note("bad", page.network, self._clock.now(), why)
        page.note_bad(TOO_LONG_WEIGHT if text is not None and len(text) > MAX_BYTES else 1)
        _reply(page, Reply(id=number, accepted=False, reason=why))
        return None

    def _handle(self, page: Page, role: Role, request: PageRequest) -> None:
        """Carry out a request, or reply why not; token and right are checked each time."""
        why = (
            refusal(role, request, self._broadcaster.robots())
            or self._broadcaster.refusal(request)
            or self._why_busy(page, request)
        )
        if why is not None:
            _reply(page, Reply(id=request.id, accepted=False, reason=why))
        elif isinstance(request, PageTokenCheck):
            _reply(page, Reply(id=request.id, accepted=True))
            page.role = role
            self._broadcaster.welcome(page)
        elif isinstance(request, PageDrive):
            self._requests.drive(request)
        else:
            task = asyncio.create_task(self._answer(page, role, request))
            page.pending.add(task)
            task.add_done_callback(page.pending.discard)

    def _why_busy(self, page: Page, request: PageRequest) -> str | None:
        """Why a page has to wait before it asks for this; None when it has not to. A stop never has to wait."""
        if isinstance(request, PageDrive):
            return self._manual_control.refusal(page, request, self._clock.now())
        if isinstance(request, PageTokenCheck) and not page.welcomes.allow(self._clock.now()):
            return "this page has checked its token too often; wait a second"
        if len(page.pending) >= _MOST_PENDING and not (isinstance(request, PageTokenCheck) or is_stop(request)):
            return f"{_MOST_PENDING} requests of this page still wait for their replies"
        return None

    async def _answer(self, page: Page, role: Role, request: PageRequest) -> None:
        """Send a request to the match, and the reply to the page."""
        reply = await self._requests.answer(role, request)
        _reply(page, reply)


async def _leaves(page: Page) -> None:
    await page.leave.wait()


def _reply(page: Page, reply: Reply) -> None:
    page.queue.put(reply.model_dump_json())


async def _close(socket: WebSocket, why: str, code: int) -> None:
    """Send a page why it is closed, and close it, without waiting for a page that does not read."""
    refusal = Refusal(reason=why).model_dump_json()
    with contextlib.suppress(WebSocketDisconnect, RuntimeError, TimeoutError):
        async with asyncio.timeout(_CLOSING_S):
            await socket.send({"type": "websocket.send", "text": refusal})
            await socket.close(code, why)


def _number(text: str) -> int | None:
    """The number of a message that is otherwise invalid; None where it has none."""
    try:
        content = from_json(text)
    except ValueError:
        return None
    number = content.get("id") if isinstance(content, dict) else None
    return number if isinstance(number, int) and not isinstance(number, bool) and number >= 0 else None
