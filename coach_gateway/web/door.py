"""The WebSocket's door: who comes in, what is read of them, and who is sent away. One page never harms another."""

import asyncio
import contextlib

from pydantic import ValidationError
from pydantic_core import from_json
from starlette.websockets import WebSocket, WebSocketDisconnect

from coach_gateway.web import access
from coach_gateway.web.desk import Desk, is_stop
from coach_gateway.web.hands import Hands
from coach_gateway.web.homes import home_of
from coach_gateway.web.origins import Origins
from coach_gateway.web.pages import Page, Pages
from coach_gateway.web.protocol import ASK, MAX_BYTES, Ask, AskDrive, AskToken, Refusal, Reply, Role
from coach_gateway.web.stage import Stage
from coach_gateway.web.tokens import Tokens
from schemas.clock import Clock

_ASKS_AT_ONCE = 8
"""Questions of one page that may wait for their answers."""
_POLICY, _TRY_AGAIN = 1008, 1013
"""WebSocket close codes: breach of the rules, and no room now."""
_PARTING_S = 1.0
_NOBODY = "nobody has this token; open the page with the address that was given out"


class Door:
    """Lets pages in."""

    def __init__(self, stage: Stage, pages: Pages, desk: Desk, tokens: Tokens, origins: Origins, clock: Clock) -> None:
        self._stage, self._pages, self._desk = stage, pages, desk
        self._tokens, self._origins, self._clock = tokens, origins, clock
        self._hands = Hands()

    async def enter(self, socket: WebSocket) -> None:
        """One page, from its coming to its going."""
        origin, host = socket.headers.get("origin"), socket.headers.get("host")
        if not self._origins.ours(origin, host):
            self._pages.counts["foreign"] += 1
            await socket.close(_POLICY)  # before it is accepted: HTTP 403
            return
        await socket.accept()
        home = home_of(socket.client.host if socket.client is not None else None)
        if why := self._pages.why_no_room(home):
            self._pages.counts["full"] += 1
            await _part(socket, why, _TRY_AGAIN)
            return
        page = Page(origin, host, self._clock.now(), home)
        self._pages.enter(page)
        self._stage.welcome(page)
        try:
            await self._attend(socket, page)
        finally:
            self._pages.forget(page)

    async def _attend(self, socket: WebSocket, page: Page) -> None:
        """Until either side leaves."""
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
                raise end  # a fault of ours ends its own page, and stands in the log
        if page.farewell:
            await _part(socket, page.farewell, _POLICY)

    async def _send(self, socket: WebSocket, page: Page) -> None:
        """Send what waits, as fast as the page reads."""
        while True:
            text = await page.outlet.next()
            page.sending_since = self._clock.now()
            await socket.send({"type": "websocket.send", "text": text})
            page.sending_since = None

    async def _read(self, socket: WebSocket, page: Page) -> None:
        """Take what the page says, until it goes."""
        while True:
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            if not page.allowance.take(self._clock.now()):
                self._too_much(page)
                continue
            ask = self._understood(page, message.get("text"))
            if ask is not None:
                self._hear(page, ask)

    def _too_much(self, page: Page) -> None:
        self._pages.counts["too much"] += 1
        page.note_bad()
        if page.scolding.take(self._clock.now()):
            _say(page, Reply(id=None, accepted=False, reason="this page says too much at once; say it more slowly"))

    def _understood(self, page: Page, text: str | None) -> Ask | None:
        """What a message asks for; one that cannot be read is counted and answered."""
        number: int | None = None
        if text is None:
            why = "only text is understood here"
        elif len(text) > MAX_BYTES:
            why = f"a message of {len(text)} characters is too long; at most {MAX_BYTES} are read"
        else:
            try:
                return ASK.validate_json(text)
            except ValidationError as error:
                number, why = _number(text), _why(error)
        self._pages.counts["bad"] += 1
        page.note_bad()
        _say(page, Reply(id=number, accepted=False, reason=why))
        return None

    def _hear(self, page: Page, ask: Ask) -> None:
        """Do what is asked, or say why not; origin, token and right are looked at each time."""
        role = self._tokens.role_of(ask.token) if self._origins.ours(page.origin, page.host) else None
        if role is None:
            self._pages.counts["wrong token"] += 1
            page.note_wrong_token()
            _say(page, Reply(id=ask.id, accepted=False, reason=_NOBODY))
            return
        why = access.refusal(role, ask, self._stage.robots()) or self._stage.refusal(ask) or self._in_the_way(page, ask)
        if why is not None:
            _say(page, Reply(id=ask.id, accepted=False, reason=why))
        elif isinstance(ask, AskToken):
            _say(page, Reply(id=ask.id, accepted=True))
            page.role = role
            self._stage.welcome(page)
        elif isinstance(ask, AskDrive):
            self._desk.drive(ask)
        else:
            task = asyncio.create_task(self._answer(page, role, ask))
            page.asks.add(task)
            task.add_done_callback(page.asks.discard)

    def _in_the_way(self, page: Page, ask: Ask) -> str | None:
        """Why a page has to wait before it asks this, or for another page; a stop never has to."""
        if isinstance(ask, AskDrive):
            return self._hands.refusal(page, ask, self._clock.now())
        if isinstance(ask, AskToken) and not page.welcomes.take(self._clock.now()):
            return "this page has asked too often what its token is worth; wait a second"
        if len(page.asks) >= _ASKS_AT_ONCE and not (isinstance(ask, AskToken) or is_stop(ask)):
            return f"{_ASKS_AT_ONCE} questions of this page still wait for their answers"
        return None

    async def _answer(self, page: Page, role: Role, ask: Ask) -> None:
        """Put a question to the match, and tell the page what came of it."""
        reply = await self._desk.answer(role, ask)
        _say(page, reply)


async def _leaves(page: Page) -> None:
    await page.leave.wait()


def _say(page: Page, reply: Reply) -> None:
    page.outlet.say(reply.model_dump_json())


async def _part(socket: WebSocket, why: str, code: int) -> None:
    """Tell a page why it is closed, and close it; one that does not read is not waited for."""
    refusal = Refusal(reason=why).model_dump_json()
    with contextlib.suppress(WebSocketDisconnect, RuntimeError, TimeoutError):
        async with asyncio.timeout(_PARTING_S):
            await socket.send({"type": "websocket.send", "text": refusal})
            await socket.close(code, why)


def _number(text: str) -> int | None:
    """The number of a message that could not be read otherwise."""
    try:
        content = from_json(text)
    except ValueError:
        return None
    number = content.get("id") if isinstance(content, dict) else None
    return number if isinstance(number, int) and not isinstance(number, bool) and number >= 0 else None


def _why(error: ValidationError) -> str:
    """What is wrong with a message, in one line."""
    first = error.errors(include_url=False)[0]
    where = ".".join(str(step) for step in first["loc"])
    return f"{where or 'the message'}: {first['msg']}"
