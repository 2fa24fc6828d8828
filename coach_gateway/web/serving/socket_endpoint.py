"""The WebSocket endpoint: admits pages, reads their messages, disconnects them. One page never harms another.

Before there is a match, pages learn whether their token is right, and command nothing.
"""

import asyncio
import contextlib

from starlette.websockets import WebSocket, WebSocketDisconnect

from coach_gateway.access.origins import Origins
from coach_gateway.access.refusals import Refusals
from coach_gateway.access.roles import TokenRole
from coach_gateway.access.tokens import UNKNOWN_TOKEN, Tokens
from coach_gateway.service import until_first
from coach_gateway.timing import CLIENT_S
from coach_gateway.web.pages.broadcaster import PageBroadcaster
from coach_gateway.web.pages.open_pages import Page, Pages
from coach_gateway.web.pages.protocol import (
    HostUpdate,
    PageDrive,
    PageRefusal,
    PageRequest,
    PageTokenCheck,
    Reply,
    Welcome,
    read_request,
)
from coach_gateway.web.pages.requests import is_stop
from schemas.wire.faults import FaultError
from schemas.wire.part import json_object

_MOST_PENDING = 8
"""Requests of one page that may wait for their replies."""
_POLICY, _TRY_AGAIN = 1008, 1013
"""WebSocket close codes: policy violation, and try again later."""
_NO_HOST = "no host plays this match yet"


class SocketEndpoint:
    """Serves the WebSockets of all pages."""

    def __init__(
        self, pages: Pages, most: int, tokens: Tokens, origins: Origins, refusals: Refusals, match: str | None
    ) -> None:
        """At most `most` pages without a token at the same time; `match` names the match that is waited for."""
        self._pages, self._most, self._tokens, self._origins = pages, most, tokens, origins
        self._refusals, self._match_name = refusals, match
        self.match: PageBroadcaster | None = None
        """What pages are shown; None before there is a match."""

    async def enter(self, socket: WebSocket) -> None:
        """Serve one page from its connection to its end."""
        origin, host = socket.headers.get("origin"), socket.headers.get("host")
        page = Page(socket.client.host if socket.client is not None else "an unknown address")
        if not self._origins.allows(origin, host):
            self._refusals.note("page of a foreign origin", page.address, f"origin {origin}")
            await socket.close(_POLICY)  # before it is accepted: HTTP 403
            return
        await socket.accept()
        first: str | None = None
        if len(self._pages) >= self._most:
            first = await self._first_with_token(socket)
            if first is None:
                self._refusals.note("page for lack of room", page.address)
                await _close(socket, f"{len(self._pages)} pages are open, which is the limit; try again later")
                return
        self._pages.enter(page)
        self._welcome(page)
        if first is not None:
            self._read_text(page, first)
        try:
            await self._run(socket, page)
        finally:
            self._pages.forget(page)

    async def _first_with_token(self, socket: WebSocket) -> str | None:
        """The first message of a page, if it has a known token: it is admitted however many people watch."""
        with contextlib.suppress(TimeoutError, FaultError):
            async with asyncio.timeout(CLIENT_S):
                text = (await socket.receive()).get("text") or ""  # it may leave, or send bytes
            if self._tokens.role_of(read_request(text).token) not in (None, TokenRole.SPECTATOR):
                return text
        return None

    def _welcome(self, page: Page) -> None:
        if self.match is not None:
            self.match.welcome(page)
            return
        name = self._match_name
        welcome = Welcome(role=page.role, match=name, setup=None, live=True, deeds=[], beliefs=[], orders=[])
        page.queue.restart(welcome.json())
        page.queue.put(HostUpdate(there=False).json())

    async def _run(self, socket: WebSocket, page: Page) -> None:
        """Serve a page until it leaves, or does not read what it is sent."""
        works = (self._send(socket, page), self._read(socket, page), page.queue.overflowed.wait())
        await until_first(*works, ignored=WebSocketDisconnect)  # an error of the server ends this page alone
        if page.queue.overflowed.is_set():
            self._refusals.note("page that does not read", page.address)

    async def _send(self, socket: WebSocket, page: Page) -> None:
        """Send what waits, as fast as the page reads; everything else that is due takes a turn after each message."""
        with contextlib.suppress(RuntimeError):  # the server has closed it, after a message that was too long
            while True:
                await socket.send_text(await page.queue.next())
                await asyncio.sleep(0)

    async def _read(self, socket: WebSocket, page: Page) -> None:
        """Read the page's messages until it leaves; everything else that is due takes a turn after each."""
        while (message := await socket.receive())["type"] != "websocket.disconnect":
            self._read_text(page, message.get("text"))
            await asyncio.sleep(0)

    def _read_text(self, page: Page, text: str | None) -> None:
        """Carry out a message, or reply why not: its form, its token and its right are checked each time."""
        request = self._parsed(page, text)
        if request is None:
            return
        role = self._tokens.role_of(request.token)
        if role is None:
            self._refusals.note("unknown token", page.address)
            _refuse(page, request.id, UNKNOWN_TOKEN)
        else:
            self._handle(page, role, request)

    def _parsed(self, page: Page, text: str | None) -> PageRequest | None:
        """The request of a message; None for one that cannot be read, which is counted and replied to."""
        number: int | None = None
        if text is None:
            why = "only text messages are read"
        else:
            try:
                return read_request(text)
            except FaultError as error:
                number, why = _number(text), str(error)
        self._refusals.note("unreadable message", page.address, why)
        _refuse(page, number, why)
        return None

    def _handle(self, page: Page, role: TokenRole, request: PageRequest) -> None:
        match = self.match
        if isinstance(request, PageTokenCheck):
            page.queue.put(Reply(id=request.id, accepted=True).json())
            if role is not page.role:
                page.role = role
                self._welcome(page)
        elif match is None:
            _refuse(page, request.id, _NO_HOST)
        elif why := match.refusal(page, role, request) or _why_busy(page, request):
            _refuse(page, request.id, why)
        elif isinstance(request, PageDrive):
            match.requests.drive(request)
        else:
            task = asyncio.create_task(self._answer(match, page, role, request))
            page.pending.add(task)
            task.add_done_callback(page.pending.discard)

    async def _answer(self, match: PageBroadcaster, page: Page, role: TokenRole, request: PageRequest) -> None:
        """Send a request to the match, and the reply to the page."""
        reply = await match.requests.answer(role, request)
        page.queue.put(reply.json())


def _why_busy(page: Page, request: PageRequest) -> str | None:
    """Why a page has to wait before it asks for this; None when it has not to. A stop never has to wait."""
    if isinstance(request, PageDrive) or is_stop(request) or len(page.pending) < _MOST_PENDING:
        return None
    return f"{_MOST_PENDING} requests of this page still wait for their replies"


def _refuse(page: Page, number: int | None, why: str) -> None:
    page.queue.put(Reply(id=number, accepted=False, reason=why).json())


async def _close(socket: WebSocket, why: str) -> None:
    """Send a page why it is closed, and close it, without waiting for a page that does not read."""
    with contextlib.suppress(WebSocketDisconnect, RuntimeError, TimeoutError):
        async with asyncio.timeout(CLIENT_S):
            await socket.send_text(PageRefusal(reason=why).json())
            await socket.close(_TRY_AGAIN, why)


def _number(text: str) -> int | None:
    """The number of a message that is otherwise invalid; None where it has none."""
    number = json_object(text).get("id")
    return number if isinstance(number, int) and not isinstance(number, bool) and number >= 0 else None
