"""Queries the setup of a match from its host before a recording begins."""

from recordings.timing import SETUP_FIRST_S, SETUP_LONGEST_S
from runtime.bus.contract import Bus, NoReplyError, PendingReply
from runtime.bus.host_watch import HostWatch
from runtime.process.timing import RECONNECT_S
from schemas.messages.setup import Setup, SetupRequest
from schemas.topics import SETUP
from schemas.wire.message import BadMessageError


class SetupQuery:
    """Repeats the query until the host replies or its time is over."""

    def __init__(self, bus: Bus, host: HostWatch) -> None:
        self._bus, self._clock, self._host = bus, bus.clock, host
        self._pending: PendingReply | None = None
        self._sent_at = self._unanswered_since = self._clock.now()
        self._pause = SETUP_FIRST_S
        self.setup: Setup | None = None
        """The reply; None without a valid one."""
        self.is_unreadable = False
        """Whether the reply was not valid."""

    def is_over(self) -> bool:
        """Whether the host has replied, or has not replied in time; sends the query when it is due."""
        now = self._clock.now()
        if self._pending is None or now - self._sent_at >= self._pause:
            self._pause = min(2 * self._pause, SETUP_LONGEST_S)
            self._pending, self._sent_at = self._bus.query(SETUP, SetupRequest(), self._pause), now
        try:
            self.setup = self._pending.result(0.0)
        except NoReplyError:
            if not self._host.seen:
                self._unanswered_since = now
            return now - self._unanswered_since >= RECONNECT_S
        except BadMessageError:
            self.is_unreadable = True
        return True
