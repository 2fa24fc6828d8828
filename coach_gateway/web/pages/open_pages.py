"""The open pages, and what is sent to them."""

import asyncio
from collections.abc import Iterator

from coach_gateway.access.roles import TokenRole
from coach_gateway.web.pages.send_queue import SendQueue


class Page:
    """One open page."""

    def __init__(self, address: str) -> None:
        """`address` is its client's, for the log."""
        self.address = address
        self.role = TokenRole.SPECTATOR
        self.queue = SendQueue()
        self.pending: set[asyncio.Task[None]] = set()
        """Requests that have no reply yet."""


class Pages:
    """All open pages."""

    def __init__(self) -> None:
        self._open: dict[Page, None] = {}

    def __len__(self) -> int:
        return len(self._open)

    def __iter__(self) -> Iterator[Page]:
        return iter(tuple(self._open))

    def enter(self, page: Page) -> None:
        """Send a page everything from now on."""
        self._open[page] = None

    def forget(self, page: Page) -> None:
        """Drop a page that has been closed."""
        self._open.pop(page, None)

    def roles(self) -> list[TokenRole]:
        """The roles of all open pages."""
        return list({page.role: None for page in self._open})

    def send(self, text: str, role: TokenRole | None = None) -> None:
        """Send to all pages, or to the pages of one role."""
        for page in self._open:
            if role is None or page.role is role:
                page.queue.put(text)

    def send_frame(self, frame: str, role: TokenRole) -> None:
        """Send the pages of a role a frame, in place of one that still waits."""
        for page in self._open:
            if page.role is role:
                page.queue.put_frame(frame)
