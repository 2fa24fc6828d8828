"""Samples of Zenoh: what their attachments mean, and waiting for them. The base of all subscriptions."""

import math
import struct
from typing import Any

import zenoh

from runtime.bus.contract import ReceivedMessage, Stamp, Subscription
from runtime.bus.zenoh.session import SessionContext
from schemas.topic import Topic

STAMP = struct.Struct("<QQq")
"""The attachment of a message: its sequence number, the publisher's wall time in ns and simulated time in ns."""
NO_WAIT = -math.inf
"""The deadline of a call that does not wait."""
_WAKE_UP = "-"
"""The attachment of a sample that only ends a wait; in its key it takes the place of chunks, whose names cannot have
this value."""
_MARK = _WAKE_UP.encode()


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
        self._wake_up_key = self._full_key.replace("*", _WAKE_UP)
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

    def _message(self, sample: zenoh.Sample, key: str, payload: bytes) -> ReceivedMessage:
        """The message in a sample; the host's router stamps the time of arrival."""
        attachment = sample.attachment
        raw = attachment.to_bytes() if attachment is not None else b""
        stamp = Stamp(*STAMP.unpack(raw)) if len(raw) == STAMP.size else None
        arrival = sample.timestamp if self._has_arrival_time else None
        arrived_ns = arrival.get_time_as_ntp64().as_nanos() if arrival is not None else 0
        return ReceivedMessage(self._topic, key, payload, stamp, arrived_ns)

    def wake(self) -> None:
        """End the current wait."""
        self._context.session.put(
            self._wake_up_key, b"", attachment=_WAKE_UP, allowed_destination=zenoh.Locality.SESSION_LOCAL
        )

    def end(self) -> None:
        """End the current wait and all later ones."""
        self._ended = True
        self.wake()

    def close(self) -> None:
        try:
            self.end()
            self._reader.undeclare()
        except zenoh.ZError:
            return  # undeclared with its session


def is_wake_up(sample: zenoh.Sample) -> bool:
    """Whether a sample only ends a wait."""
    attachment = sample.attachment
    return attachment is not None and attachment.to_bytes() == _MARK
