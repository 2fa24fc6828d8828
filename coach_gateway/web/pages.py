"""The pages that are open: what each is told, and what is held against it."""

import asyncio
from collections import Counter
from collections.abc import Iterator

from coach_gateway.access.rate_limit import TokenBucket
from coach_gateway.access.roles import Role
from coach_gateway.web.send_queue import SendQueue

MESSAGES_PER_S = 100.0
"""What a page may say; one that drives a robot says 20."""
MESSAGES_AT_ONCE = 200.0
STUCK_S = 5.0
"""Wall time in s after which a page that does not read is dropped."""
_MOST_BAD = 500
"""Messages that could not be read or were too many, after which a page is sent away."""
_WRONG_TOKENS = 20


_FAULTS = {
    "foreign": "pages from elsewhere",
    "full": "pages without room",
    "bad": "messages that could not be read",
    "too much": "messages too many",
    "wrong token": "uses of a token that is nobody's",
    "stuck": "pages that did not read",
}
"""What may go wrong with pages, by kind, in words."""


class Page:
    """One open page."""

    def __init__(self, origin: str | None, host: str | None, now: float, network: str | None = None) -> None:
        """`network` is whom its room is counted for, as `coach_gateway.access.client_network.client_network` has it."""
        self.origin, self.host, self.network = origin, host, network
        self.role = Role.SPECTATOR
        self.queue = SendQueue()
        self.rate_limit = TokenBucket(MESSAGES_PER_S, MESSAGES_AT_ONCE, now)
        self.rate_limit_notice = TokenBucket(1.0, 5.0, now)
        """How often it is told that it says too much."""
        self.welcomes = TokenBucket(1.0, 5.0, now)
        """How often it is welcomed anew because it pending: a welcome brings the whole past with it."""
        self.pending: set[asyncio.Task[None]] = set()
        """What it has asked and not yet been answered."""
        self.sending_since: float | None = None
        """Wall time in s since which it has been sent one message."""
        self.leave = asyncio.Event()
        """It is sent away, or does not read."""
        self.close_reason = ""
        """Why it is sent away."""
        self._bad = 0
        self._wrong_tokens = 0

    def send_away(self, why: str) -> None:
        """Close it, telling it why."""
        self.close_reason = self.close_reason or why
        self.leave.set()

    def note_bad(self) -> None:
        """It said what could not be read, or too much."""
        self._bad += 1
        if self._bad > _MOST_BAD:
            self.send_away("this page says too much that cannot be understood")

    def note_wrong_token(self) -> None:
        """It used a token that is nobody's."""
        self._wrong_tokens += 1
        if self._wrong_tokens > _WRONG_TOKENS:
            self.send_away("this page has tried too many tokens")

    def is_stuck(self, now: float) -> bool:
        """It does not read what it is sent."""
        since = self.sending_since
        return self.queue.overflows or (since is not None and now - since > STUCK_S)


class Pages:
    """All of them."""

    def __init__(self, most: int, each: int) -> None:
        """So many at once, and so many of them from one home."""
        self._most, self._each = most, each
        self._open: dict[Page, None] = {}
        self.counts: Counter[str] = Counter()
        """What went wrong, by kind."""

    def fault_summary(self) -> str:
        """What went wrong, in words; empty where nothing did."""
        return ", ".join(f"{self.counts[kind]} {words}" for kind, words in _FAULTS.items() if self.counts[kind])

    def __len__(self) -> int:
        return len(self._open)

    def __iter__(self) -> Iterator[Page]:
        return iter(tuple(self._open))

    def why_no_room(self, network: str | None) -> str:
        """Why no further page of this network is let in, or nothing."""
        if len(self) >= self._most:
            return f"{len(self)} pages are open, and no more are let in; try again later"
        if network is not None and sum(page.network == network for page in self._open) >= self._each:
            return f"{self._each} pages of your address are open; close one, or have more let in: --pages-per-address"
        return ""

    def enter(self, page: Page) -> None:
        """It is told everything from now on."""
        self._open[page] = None

    def forget(self, page: Page) -> None:
        """It has been closed."""
        self._open.pop(page, None)

    def roles(self) -> list[Role]:
        """The roles that anybody watches in."""
        there = {page.role: None for page in self._open}
        return list(there)

    def send(self, text: str, role: Role | None = None) -> None:
        """Tell all pages, or those of one role."""
        for page in self._open:
            if role is None or page.role is role:
                page.queue.put(text)

    def send_frame(self, frame: str, role: Role) -> None:
        """Show the pages of a role a frame, in place of one that they have not read yet."""
        for page in self._open:
            if page.role is role:
                page.queue.put_frame(frame)

    def drop_stuck(self, now: float) -> None:
        """Drop those that do not read."""
        for page in self:
            if page.is_stuck(now):
                self.counts["stuck"] += 1
                page.leave.set()
