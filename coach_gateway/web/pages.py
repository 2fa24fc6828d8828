"""The open pages: what is sent to each, and what each has done wrong."""

import asyncio
import hmac
from collections import Counter
from collections.abc import Callable, Iterator

from coach_gateway.access.network_limits import NetworkLimits
from coach_gateway.access.rate_limit import TokenBucket
from coach_gateway.access.refusals import Refusals
from coach_gateway.access.roles import Role
from coach_gateway.web.send_queue import SendQueue

MESSAGES_PER_S = 100.0
"""Messages that a page may send per second of wall time; a page that drives a robot sends 20."""
MESSAGES_AT_ONCE = 200.0
STUCK_S = 5.0
"""Wall time in s after which a page that does not read is dropped."""
OPENED_PER_S, OPENED_AT_ONCE = 5.0, 300.0
"""Pages that one network may open per s of wall time, and at once: each is sent everything that is known."""
TOO_LONG_WEIGHT = 50
"""Unreadable messages that one beyond the longest counts for."""
_MOST_BAD = 200
"""Unreadable or excess messages after which a page is disconnected."""
_WRONG_TOKENS = 20
"""Unknown tokens after which a page is disconnected."""

_FAULTS = {
    "connections": ("connection beyond the rate limit", "connections beyond the rate limit"),
    "requests": ("request beyond the rate limit", "requests beyond the rate limit"),
    "crowded": ("connection closed to make room", "connections closed to make room"),
    "late": ("request that was not complete in time", "requests that were not complete in time"),
    "broken": ("connection that broke the protocol", "connections that broke the protocol"),
    "control frames": ("flood of control frames", "floods of control frames"),
    "frames": ("flood of frames", "floods of frames"),
    "bytes": ("flood of bytes", "floods of bytes"),
    "host": ("request for an unknown host name", "requests for an unknown host name"),
    "opened": ("page opened beyond the rate limit", "pages opened beyond the rate limit"),
    "foreign": ("page refused for its origin", "pages refused for their origin"),
    "full": ("page refused for lack of room", "pages refused for lack of room"),
    "bad": ("unreadable message", "unreadable messages"),
    "too much": ("message beyond the rate limit", "messages beyond the rate limit"),
    "wrong token": ("unknown token", "unknown tokens"),
    "stuck": ("page dropped that did not read", "pages dropped that did not read"),
}
"""Kind of fault → its description for one, and for several."""


class Page:
    """One open page."""

    def __init__(self, origin: str | None, host: str | None, now: float, network: str | None = None) -> None:
        """`network` is counted for the page, as returned by `coach_gateway.access.client_network.client_network`."""
        self.origin, self.host, self.network = origin, host, network
        self.role = Role.SPECTATOR
        self.queue = SendQueue()
        self.rate_limit = TokenBucket(MESSAGES_PER_S, MESSAGES_AT_ONCE, now)
        self.rate_limit_notice = TokenBucket(1.0, 5.0, now)
        """How often it is notified of the rate limit."""
        self.welcomes = TokenBucket(1.0, 5.0, now)
        """How often it is welcomed again on request: a welcome brings all past events with it."""
        self.pending: set[asyncio.Task[None]] = set()
        """Requests that have no reply yet."""
        self.sending_since: float | None = None
        """Wall time in s since which one message is being sent to it; None while none is."""
        self.leave = asyncio.Event()
        """Set when it is to be disconnected."""
        self.close_reason = ""
        """Why it is disconnected; empty where it does not read."""
        self.checks_later = False
        """A token of its is to be checked after a pause."""
        self._proven = b""
        self._bad = 0
        self._wrong_tokens = 0

    def disconnect(self, why: str) -> None:
        """Close it with a reason."""
        self.close_reason = self.close_reason or why
        self.leave.set()

    def note_bad(self, weight: int = 1) -> None:
        """Count an unreadable message, or one beyond the rate limit; one that costs more effort has more weight."""
        self._bad += weight
        if self._bad > _MOST_BAD:
            self.disconnect("this page has sent too many messages that could not be read or were beyond the rate limit")

    def note_wrong_token(self) -> None:
        """Count the use of an unknown token."""
        self._wrong_tokens += 1
        if self._wrong_tokens > _WRONG_TOKENS:
            self.disconnect("this page has tried too many tokens")

    def note_right_token(self, token: str) -> None:
        """Keep the token that it has proven to know; it is not held up by wrong ones from its network."""
        self._proven = token.encode(errors="replace")

    def has_proven(self, token: str) -> bool:
        """Whether it has used this token before, or uses none."""
        return not token or hmac.compare_digest(self._proven, token.encode(errors="replace"))

    def is_stuck(self, now: float) -> bool:
        """Whether it does not read what it is sent."""
        since = self.sending_since
        return self.queue.overflows or (since is not None and now - since > STUCK_S)


class Pages:
    """All open pages."""

    def __init__(self, most: int, each: int, log: Callable[[str], None] = lambda _: None) -> None:
        """At most `most` pages at once, of these at most `each` from one network."""
        self._most, self._each = most, each
        self._open: dict[Page, None] = {}
        self._openings = NetworkLimits(OPENED_PER_S, OPENED_AT_ONCE)
        self.refusals = Refusals("page", log, {kind: one for kind, (one, _) in _FAULTS.items()})
        """Faults by kind."""

    @property
    def counts(self) -> Counter[str]:
        """Faults by kind."""
        return self.refusals.counts

    def fault_summary(self) -> str:
        """All faults with their numbers, as text; empty where there are none."""
        return ", ".join(
            f"{count} {one if count == 1 else many}"
            for kind, (one, many) in _FAULTS.items()
            if (count := self.counts[kind])
        )

    def __len__(self) -> int:
        return len(self._open)

    def __iter__(self) -> Iterator[Page]:
        return iter(tuple(self._open))

    def may_open(self, network: str | None, now: float) -> bool:
        """Whether a network may open one more page, or has opened too many in a short time; counts it."""
        allowed = self._openings.allow(network, now)
        if not allowed:
            self.refusals.note("opened", network, now)
        return allowed

    def why_no_room(self, network: str | None) -> str:
        """Why no further page of this network is admitted; empty when it is."""
        if len(self) >= self._most:
            return f"{len(self)} pages are open, which is the limit; try again later"
        if network is not None and sum(page.network == network for page in self._open) >= self._each:
            return f"{self._each} pages of your address are open; close one, or raise --pages-per-address"
        return ""

    @property
    def beyond_limit(self) -> int:
        """Pages that are open beyond the limit of all."""
        return max(0, len(self) - self._most)

    def enter(self, page: Page) -> None:
        """Send a page everything from now on."""
        self._open[page] = None

    def forget(self, page: Page) -> None:
        """Drop a page that has been closed."""
        self._open.pop(page, None)

    def roles(self) -> list[Role]:
        """The roles of all open pages."""
        there = {page.role: None for page in self._open}
        return list(there)

    def send(self, text: str, role: Role | None = None) -> None:
        """Send to all pages, or to those of one role."""
        for page in self._open:
            if role is None or page.role is role:
                page.queue.put(text)

    def send_frame(self, frame: str, role: Role) -> None:
        """Send the pages of a role a frame, in place of one that still waits."""
        for page in self._open:
            if page.role is role:
                page.queue.put_frame(frame)

    def drop_stuck(self, now: float) -> None:
        """Drop pages that do not read."""
        for page in self:
            if page.is_stuck(now):
                self.refusals.note("stuck", page.network, now)
                page.leave.set()
