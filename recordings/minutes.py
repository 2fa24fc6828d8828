"""What was said in a match, out of the minutes that its host keeps: each message as it came from its own sender."""

from functools import lru_cache

from schemas.bus.contract import Received, Stamp
from schemas.message import BadMessageError
from schemas.minutes import Entry, read_minutes
from schemas.topic import Topic
from schemas.topics import TOPICS

_RECORDED = tuple(topic for topic in TOPICS.values() if topic.recorded)


@lru_cache(1024)
def _topic_of(key: str) -> Topic | None:
    """The row that a key belongs to."""
    return next((topic for topic in _RECORDED if topic.match(key) is not None), None)


def received_of(minutes: Received) -> list[Received]:
    """The messages that minutes hold; keys of no recorded topic are passed over.

    Raises:
        BadMessageError: they are no minutes.
    """
    found = []
    for entry in read_minutes(minutes.payload):
        key, number = entry.key, entry.sequence
        topic = _topic_of(key)
        if topic is not None:
            payload = bytes(entry.message) if entry.octets is None else _octets(entry)
            stamp = Stamp(number, entry.sent_ns, entry.sim_ns) if number is not None else None
            found.append(Received(topic, key, payload, stamp, entry.arrived_ns))
    return found


def _octets(entry: Entry) -> bytes:
    try:
        return entry.payload
    except ValueError as error:
        raise BadMessageError(f"Minutes: octets of {entry.key}: {error}") from None
