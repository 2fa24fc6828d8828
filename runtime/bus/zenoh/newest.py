"""Subscription to the newest message of one key over Zenoh, with which a robot reads its sights.

A robot is woken for each sight after nine others have used the CPU's caches, so this path is short: it reads neither
key nor stamp unless the caller needs them.
"""

import zenoh

from runtime.bus.contract import ReceivedMessage
from runtime.bus.zenoh.reader import NO_WAIT, ZenohReader, is_wake_up
from runtime.bus.zenoh.session import SessionContext
from schemas.topic import Topic

_PLACES = 2
"""Places of the ring: one more than the newest message, so that a wake-up never displaces it."""


class ZenohNewest(ZenohReader):
    """Keeps only the newest message."""

    def __init__(self, topic: Topic, key: str, context: SessionContext) -> None:
        super().__init__(topic, key, context)
        self._key = key
        self._reader = context.session.declare_subscriber(self._full_key, zenoh.handlers.RingChannel(_PLACES))

    def receive(self, timeout: float | None = 0.0) -> ReceivedMessage | None:
        newest = self._newest(timeout)
        if newest is None:
            return None
        sample, payload = newest
        return self._message(sample, self._key, payload)

    def receive_payload(self, timeout: float | None = 0.0) -> bytes | None:
        newest = self._newest(timeout)
        return newest[1] if newest is not None else None

    def _newest(self, timeout: float | None) -> tuple[zenoh.Sample, bytes] | None:
        """The last sample that arrived, and its payload."""
        until = NO_WAIT if self._ended else self._deadline_of(timeout)
        newest, reader = None, self._reader
        try:
            sample = self._wait(until) if until > NO_WAIT else reader.try_recv()
            while sample is not None:
                payload = sample.payload.to_bytes()
                if payload or not is_wake_up(sample):
                    newest = sample, payload
                is_early = newest is None and not self._ended and self._clock.now() < until
                sample = self._wait(until) if is_early else reader.try_recv()
        except zenoh.ZError:
            return newest  # the session was closed
        return newest
