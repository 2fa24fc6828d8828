"""Waiting for samples of Zenoh's: what every reader of messages has in common."""

import math
from typing import Any

import zenoh

from schemas.bus.contract import Subscription
from schemas.bus.session import Seat
from schemas.bus.zenoh_sample import POKE
from schemas.topic import Topic

AT_ONCE = -math.inf
"""End of a wait that is none."""


class ZenohReader(Subscription):
    """Samples wait in a channel of Zenoh's own, filled without Python: neither side ever waits for the other's GIL.

    A channel can be waited on only without end, so a wait that has one is ended by a poke: a sample that the bus's
    alarm puts on this reader's own key, heard by nobody else.
    """

    def __init__(self, topic: Topic, key: str, seat: Seat) -> None:
        self.ends_at = math.inf
        """When the alarm has to end the wait that is on, by the clock in s."""
        self._topic = topic
        self._seat = seat
        self._clock = seat.clock
        self._timed = not seat.is_client
        self._ended = False
        self._full_key = seat.prefix + key
        self._poke_key = self._full_key.replace("*", POKE)
        self._reader: Any = None
        """What Zenoh fills; declared by each kind of reader."""

    def _until(self, timeout: float | None) -> float:
        """When a wait ends that may take `timeout` s."""
        if timeout is None:
            return math.inf
        return self._clock.now() + timeout if timeout else AT_ONCE

    def _wait(self, until: float) -> zenoh.Sample:
        """The next sample in the channel, a poke at the latest.

        Raises:
            ZError: the session was closed.
        """
        alarm = self._seat.alarm
        self.ends_at = until
        if until < alarm.looks_at:
            alarm.ring()
        try:
            sample: zenoh.Sample = self._reader.recv()
        finally:
            self.ends_at = math.inf
        return sample

    def poke(self) -> None:
        """End a wait."""
        self._seat.session.put(self._poke_key, b"", attachment=POKE, allowed_destination=zenoh.Locality.SESSION_LOCAL)

    def end(self) -> None:
        """Wake the reader for good."""
        self._ended = True
        self.poke()

    def close(self) -> None:
        self.end()
        try:
            self._reader.undeclare()
        except zenoh.ZError:
            return  # undeclared already, with its session
