"""Waiting for samples of Zenoh's: what every reader of messages has in common."""

import math
from typing import Any

import zenoh

from schemas.bus.contract import Subscription
from schemas.bus.zenoh.sample import WAKE_UP
from schemas.bus.zenoh.session import SessionContext
from schemas.topic import Topic

NO_WAIT = -math.inf
"""End of a wait that is none."""


class ZenohReader(Subscription):
    """Samples wait in a channel of Zenoh's own, filled without Python: neither side ever waits for the other's GIL.

    A channel can be waited on only without end, so a wait that has one is ended by a wake-up: a sample that the bus's
    timer puts on this reader's own key, heard by nobody else.
    """

    def __init__(self, topic: Topic, key: str, context: SessionContext) -> None:
        self.deadline = math.inf
        """When the timer has to end the wait that is on, by the clock in s."""
        self._topic = topic
        self._context = context
        self._clock = context.clock
        self._timed = not context.is_client
        self._ended = False
        self._full_key = context.prefix + key
        self._wake_up_key = self._full_key.replace("*", WAKE_UP)
        self._reader: Any = None
        """What Zenoh fills; declared by each kind of reader."""

    def _deadline_of(self, timeout: float | None) -> float:
        """When a wait ends that may take `timeout` s."""
        if timeout is None:
            return math.inf
        return self._clock.now() + timeout if timeout else NO_WAIT

    def _wait(self, until: float) -> zenoh.Sample:
        """The next sample in the channel, a wake-up at the latest.

        Raises:
            ZError: the session was closed.
        """
        timer = self._context.timer
        self.deadline = until
        if until < timer.next_check_at:
            timer.check_now()
        try:
            sample: zenoh.Sample = self._reader.recv()
        finally:
            self.deadline = math.inf
        return sample

    def wake(self) -> None:
        """End a wait."""
        self._context.session.put(
            self._wake_up_key, b"", attachment=WAKE_UP, allowed_destination=zenoh.Locality.SESSION_LOCAL
        )

    def end(self) -> None:
        """Wake the reader for good."""
        self._ended = True
        self.wake()

    def close(self) -> None:
        self.end()
        try:
            self._reader.undeclare()
        except zenoh.ZError:
            return  # undeclared already, with its session
