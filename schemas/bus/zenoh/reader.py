"""Waiting for samples of Zenoh: the base of all subscriptions."""

import math
from typing import Any

import zenoh

from schemas.bus.contract import Subscription
from schemas.bus.zenoh.sample import WAKE_UP
from schemas.bus.zenoh.session import SessionContext
from schemas.topic import Topic

NO_WAIT = -math.inf
"""The deadline of a call that does not wait."""


class ZenohReader(Subscription):
    """Samples wait in a channel of Zenoh, which is filled without Python: neither side waits for the GIL of the other.

    A channel has no wait with a timeout. The bus's timer ends such a wait with a wake-up: a sample that it puts on this
    reader's key, delivered only within the session.
    """

    def __init__(self, topic: Topic, key: str, context: SessionContext) -> None:
        self.deadline = math.inf
        """When the timer has to end the current wait, by the clock in s."""
        self._topic = topic
        self._context = context
        self._clock = context.clock
        self._has_arrival_time = not context.is_client
        self._ended = False
        self._full_key = context.prefix + key
        self._wake_up_key = self._full_key.replace("*", WAKE_UP)
        self._reader: Any = None
        """The Zenoh subscriber; declared by each kind of reader."""

    def _deadline_of(self, timeout: float | None) -> float:
        """When a wait of `timeout` s ends."""
        if timeout is None:
            return math.inf
        return self._clock.now() + timeout if timeout else NO_WAIT

    def _wait(self, until: float) -> zenoh.Sample:
        """The next sample in the channel, at the latest a wake-up.

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
        """End the current wait."""
        self._context.session.put(
            self._wake_up_key, b"", attachment=WAKE_UP, allowed_destination=zenoh.Locality.SESSION_LOCAL
        )

    def end(self) -> None:
        """End the current wait and all later ones."""
        self._ended = True
        self.wake()

    def close(self) -> None:
        self.end()
        try:
            self._reader.undeclare()
        except zenoh.ZError:
            return  # undeclared with its session
