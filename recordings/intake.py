"""What robots and coaches sent, out of what the host handed on: each message as it came from its own sender."""

from functools import lru_cache
from typing import Annotated

import msgspec

from schemas.bus.contract import Received, Stamp
from schemas.intake import MAX_KEY, Intake
from schemas.message import VERSION, BadMessageError
from schemas.topic import Party, Topic
from schemas.topics import TOPICS

_OTHERS = tuple(topic for topic in TOPICS.values() if topic.recorded and topic.writer is not Party.HOST)
"""The rows that are recorded and that others than the host write."""


class _PlainEntry(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """An `IntakeEntry` whose payload is text and whose sender numbers what it sends."""

    key: Annotated[str, msgspec.Meta(max_length=MAX_KEY)]
    text: str
    sequence: Annotated[int, msgspec.Meta(ge=0)]
    sent_ns: int
    sim_ns: int
    arrived_ns: int


class _PlainIntake(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """An `Intake` as this library's hosts write it."""

    version: str
    tick: int
    entries: list[_PlainEntry]


_decode = msgspec.json.Decoder(_PlainIntake).decode


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
    """The messages where all of it is as this library's hosts write it, in a fifth of the time; else nothing."""
    if len(payload) > Intake.max_bytes:
        return None
    try:
        intake = _decode(payload)
        if intake.version != VERSION:
            return None
        return [
            Received(topic, one.key, one.text.encode(), Stamp(one.sequence, one.sent_ns, one.sim_ns), one.arrived_ns)
            for one in intake.entries
            if (topic := _topic_of(one.key)) is not None
        ]
    except (ValueError, RecursionError):
        return None


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
