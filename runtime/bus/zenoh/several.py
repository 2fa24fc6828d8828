"""Subscription to the newest messages of several keys over Zenoh: one thread reads the sights of many robots.

Samples wait in a queue of Python, whose wait has a timeout. Zenoh's channels would need a thread for each key; for one
key a channel is cheaper (`runtime.bus.zenoh.newest`).
"""

from collections.abc import Sequence

import zenoh

from runtime.bus.contract import ReceivedMessage
from runtime.bus.mailbox import Mailbox
from runtime.bus.zenoh.reader import ZenohReader, is_wake_up
from runtime.bus.zenoh.session import SessionContext
from schemas.topic import Topic


class ZenohSeveral(ZenohReader):
    """Keeps only the newest message of each key."""

    def __init__(self, topic: Topic, keys: Sequence[str], context: SessionContext) -> None:
        super().__init__(topic, topic.fill(), context)
        self._keys = {context.prefix + key: key for key in keys}
        self._kept: dict[str, tuple[zenoh.Sample, zenoh.ZBytes]] = {}
        self._mailbox: Mailbox[zenoh.Sample] = Mailbox()
        into_mailbox = zenoh.handlers.Callback(self._mailbox.put, indirect=False)
        self._readers = [context.session.declare_subscriber(key, into_mailbox) for key in self._keys]

    def receive(self, timeout: float | None = 0.0) -> ReceivedMessage | None:
        kept, mailbox = self._kept, self._mailbox
        sample = mailbox.get(0.0 if kept else timeout)
        while sample is not None:
            key, payload = self._keys.get(str(sample.key_expr)), sample.payload
            # without a key somebody publishes on one with wildcards, and a wake-up is that of another reader
            if key is not None and (len(payload) or not is_wake_up(sample)):
                kept.pop(key, None)
                kept[key] = sample, payload
            sample = mailbox.get(0.0)
        if not kept:
            return None
        key = next(iter(kept))
        sample, payload = kept.pop(key)
        return self._message(sample, key, payload.to_bytes())

    def wake(self) -> None:
        """End all waits."""
        self._mailbox.close()

    def close(self) -> None:
        self.end()
        for reader in self._readers:
            try:
                reader.undeclare()  # type: ignore[no-untyped-call]
            except zenoh.ZError:
                return  # undeclared with its session
