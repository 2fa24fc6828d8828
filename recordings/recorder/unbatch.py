"""What was said in a match, out of the record batches of its host: each message as it came from its own sender."""

from functools import lru_cache

from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.message import BadMessageError
from schemas.messages.record_batch import RawEntry, decode_batch
from schemas.topic import Topic
from schemas.topics import TOPICS

_RECORDED = tuple(topic for topic in TOPICS.values() if topic.recorded)


@lru_cache(1024)
def _topic_of(key: str) -> Topic | None:
    """The row that a key belongs to."""
    return next((topic for topic in _RECORDED if topic.match(key) is not None), None)


def unbatch(batch: ReceivedMessage) -> list[ReceivedMessage]:
    """The messages that a record batch holds; keys of no recorded topic are passed over.

    Raises:
        BadMessageError: it is no record batch.
    """
    messages = []
    for entry in decode_batch(batch.payload):
        key, sequence = entry.key, entry.sequence
        topic = _topic_of(key)
        if topic is not None:
            payload = bytes(entry.message) if entry.octets is None else _octets(entry)
            stamp = Stamp(sequence, entry.sent_ns, entry.sim_ns) if sequence is not None else None
            messages.append(ReceivedMessage(topic, key, payload, stamp, entry.arrived_ns))
    return messages


def _octets(entry: RawEntry) -> bytes:
    try:
        return entry.payload
    except ValueError as error:
        raise BadMessageError(f"RecordBatch: octets of {entry.key}: {error}") from None
