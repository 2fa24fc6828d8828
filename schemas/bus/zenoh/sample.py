"""What a sample of Zenoh's carries beside its payload: a message's stamp, or the mark of a wake-up."""

import struct

import zenoh

from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.topic import Topic

STAMP = struct.Struct("<QQq")
"""What travels beside each message: its number, the writer's wall time in ns and simulated time in ns."""
WAKE_UP = "-"
"""Marks a sample that only ends a wait; stands for the chunks of its key, where no name can be this."""
_MARK = WAKE_UP.encode()


def is_wake_up(sample: zenoh.Sample) -> bool:
    """Whether a sample only ends a wait."""
    attachment = sample.attachment
    return attachment is not None and attachment.to_bytes() == _MARK


def message_in(sample: zenoh.Sample, topic: Topic, key: str, payload: bytes, timed: bool) -> ReceivedMessage:
    """The message in a sample; with the time of its arrival where the receiver is the one who stamps that."""
    attachment = sample.attachment
    raw = attachment.to_bytes() if attachment is not None else b""
    stamp = Stamp(*STAMP.unpack(raw)) if len(raw) == STAMP.size else None
    return ReceivedMessage(topic, key, payload, stamp, _arrival(sample) if timed else 0)


def _arrival(sample: zenoh.Sample) -> int:
    """When the host's router stamped the sample: where and when it came in, ns since 1970; 0 when it did not."""
    stamp = sample.timestamp
    return stamp.get_time_as_ntp64().as_nanos() if stamp is not None else 0
