"""The door of a full server: who has a token is admitted all the same, however many watch."""

import asyncio
from collections import Counter

from pydantic import ValidationError
from starlette.websockets import WebSocket

from coach_gateway.access.roles import Role
from coach_gateway.web.pages import Page, Pages
from coach_gateway.web.protocol import MAX_BYTES, PAGE_REQUEST
from coach_gateway.web.token_gate import TokenGate

PATIENCE_S = 1.0
"""s of wall time in which a page has to send its token; the page sends it first of all."""
MOST, MOST_EACH = 32, 8
"""Pages at the door at the same time, and of one network."""
RESERVED = 30
"""Pages with a token that are admitted beyond the limit."""


class Door:
    """The pages that are refused unless they send a token."""

    def __init__(self, gate: TokenGate, pages: Pages) -> None:
        self._gate, self._pages = gate, pages
        self._there: Counter[str | None] = Counter()

    async def first_message(self, socket: WebSocket, page: Page) -> str | None:
        """The first message of a page that sends a known token with it; None for every other page."""
        if self._there.total() >= MOST or self._there[page.network] >= MOST_EACH:
            return None
        if self._pages.beyond_limit >= RESERVED:
            return None
        self._there[page.network] += 1
        try:
            async with asyncio.timeout(PATIENCE_S):
                message = await socket.receive()
            text = message.get("text")
            if text is None or len(text) > MAX_BYTES:
                return None
            request = PAGE_REQUEST.validate_json(text)
            role = await self._gate.role_at_door(page, request.token)
        except (TimeoutError, ValidationError):
            return None
        finally:
            self._there[page.network] -= 1
            self._there += Counter()
        return None if role is Role.SPECTATOR else text
