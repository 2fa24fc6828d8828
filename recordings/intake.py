"""What robots and coaches sent, out of what the host handed on: each message as it came from its own sender."""

from functools import lru_cache

from pydantic_core import from_json

from schemas.bus.contract import Received, Stamp
from schemas.intake import MAX_KEY, Intake, IntakeEntry
from schemas.message import VERSION, BadMessageError
from schemas.topic import Party, Topic
from schemas.topics import TOPICS

_OTHERS = tuple(topic for topic in TOPICS.values() if topic.recorded and topic.writer is not Party.HOST)
"""The rows that are recorded and that others than the host write."""
_FIELDS = Intake.model_fields.keys()
_ENTRY = IntakeEntry.model_fields.keys() - {"octets"}
"""Of an entry whose payload is text and whose sender numbers what it sends."""


@lru_cache(1024)
def _topic_of(key: str) -> Topic | None:
    """The row that a key belongs to."""
    return next((topic for topic in _OTHERS if topic.match(key) is not None), None)


def received_of(intake: Received) -> list[Received]:
    """The messages that a message of the host's intake holds; keys of no recorded topic are passed over.

    Raises:
        BadMessageError: it is no intake.
    """
    found = _plain(intake.payload)
    return found if found is not None else _validated(intake)


def _plain(payload: bytes) -> list[Received] | None:
    """The messages where all of it is as this library's hosts write it, in half the time; else nothing."""
    if len(payload) > Intake.max_bytes:
        return None
    try:
        content = from_json(payload)
        if content.keys() != _FIELDS or content["version"] != VERSION or type(content["tick"]) is not int:
            return None
        found = []
        for entry in content["entries"]:
            if entry.keys() != _ENTRY:
                return None
            key, text, number = entry["key"], entry["text"], entry["sequence"]
            sent_ns, sim_ns, arrived_ns = entry["sent_ns"], entry["sim_ns"], entry["arrived_ns"]
            whole = type(number) is type(sent_ns) is type(sim_ns) is type(arrived_ns) is int and number >= 0
            if not whole or type(key) is not str or len(key) > MAX_KEY or type(text) is not str:
                return None
            topic = _topic_of(key)
            if topic is not None:
                found.append(Received(topic, key, text.encode(), Stamp(number, sent_ns, sim_ns), arrived_ns))
    except (ValueError, AttributeError, TypeError, LookupError):
        return None
    return found


def _validated(intake: Received) -> list[Received]:
    """The messages, whatever of them is left out or in base64."""
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
