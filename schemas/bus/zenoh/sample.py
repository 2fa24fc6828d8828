"""The attachment of a Zenoh sample: the stamp of a message, or the mark of a wake-up."""

import struct

import zenoh

from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.topic import Topic

STAMP = struct.Struct("<QQq")
"""The attachment of a message: its sequence number, the publisher's wall time in ns and simulated time in ns."""
WAKE_UP = "-"
"""Marks a sample that only ends a wait; in its key it takes the place of chunks, whose names cannot have this value."""
NO_KEY = "its key is no key of a topic"
"""Why a message on a key with wildcards, or on one that no topic has, is refused."""
_MARK = WAKE_UP.encode()


def is_wake_up(sample: zenoh.Sample) -> bool:
    """Whether a sample only ends a wait."""
    attachment = sample.attachment
    return attachment is not None and attachment.to_bytes() == _MARK


def message_in(sample: zenoh.Sample, topic: Topic, key: str, payload: bytes, timed: bool) -> ReceivedMessage:
    """The message in a sample; `timed` adds its time of arrival, which only the host's router stamps."""
    attachment = sample.attachment
    raw = attachment.to_bytes() if attachment is not None else b""
    stamp = Stamp(*STAMP.unpack(raw)) if len(raw) == STAMP.size else None
    return ReceivedMessage(topic, key, payload, stamp, _arrival(sample) if timed else 0)


def _arrival(sample: zenoh.Sample) -> int:
    """Wall time at which the host's router stamped the sample on arrival, ns since 1970; 0 without a stamp."""
    stamp = sample.timestamp
    return stamp.get_time_as_ntp64().as_nanos() if stamp is not None else 0
