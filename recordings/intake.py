"""What robots and coaches sent, out of what the host handed on: each message as it came from its own sender."""

from functools import lru_cache

from schemas.bus.contract import Received, Stamp
from schemas.intake import Intake
from schemas.message import BadMessageError
from schemas.topic import Party, Topic
from schemas.topics import TOPICS

_OTHERS = tuple(topic for topic in TOPICS.values() if topic.recorded and topic.writer is not Party.HOST)
"""The rows that are recorded and that others than the host write."""


@lru_cache(1024)
def _topic_of(key: str) -> Topic | None:
    """The row that a key belongs to."""
    return next((topic for topic in _OTHERS if topic.match(key) is not None), None)


def received_of(intake: Received) -> list[Received]:
    """The messages that a message of the host's intake holds; keys of no recorded topic are passed over.

    Raises:
        BadMessageError: it is no intake.
    """
    message: Intake = intake.message()
    found = []
    for entry in message.entries:
        try:
            payload = entry.payload
        except ValueError as error:
            raise BadMessageError(f"Intake: octets of {entry.key}: {error}") from None
        topic = _topic_of(entry.key)
        if topic is None:
            continue
        stamp = Stamp(entry.sequence, entry.sent_ns, entry.sim_ns) if entry.sequence is not None else None
        found.append(Received(topic, entry.key, payload, stamp, entry.arrived_ns))
    return found
