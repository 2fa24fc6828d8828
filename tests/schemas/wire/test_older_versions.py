"""The table of renamings agrees with the protocol, and payloads of older versions are converted."""

import msgspec
import pytest
from pydantic import BaseModel

from schemas.protocol.examples import examples
from schemas.protocol.fields import is_part, parts_of
from schemas.topics import TOPICS
from schemas.wire.message import VERSION
from schemas.wire.older_versions import MAJOR, READABLE, RENAMINGS, Renaming, converted, is_readable

KEYS = {topic.key for topic in TOPICS.values()}


def fields_in(kinds: set[type]) -> set[str]:
    """`Message.field` of messages and all parts in them."""
    known, waiting = set(kinds), list(kinds)
    while waiting:
        kind = waiting.pop()
        new = {part for part in parts_of(kind) if is_part(part)} - known
        known |= new
        waiting += new
    return {
        f"{kind.__name__}.{name}"
        for kind in known
        if issubclass(kind, BaseModel | msgspec.Struct)
        for name in (kind.model_fields if issubclass(kind, BaseModel) else kind.__struct_fields__)
    }


NAMES = KEYS | fields_in({kind for topic in TOPICS.values() for kind in (topic.message, topic.reply) if kind})


@pytest.mark.parametrize("renaming", RENAMINGS, ids=lambda renaming: renaming.before)
def test_a_new_name_is_in_the_protocol_and_the_old_one_is_not(renaming: Renaming) -> None:
    assert renaming.after in NAMES and renaming.before not in NAMES


def test_nothing_that_is_recorded_was_renamed() -> None:
    """Otherwise `converted` has to rename it."""
    recorded = [topic for topic in TOPICS.values() if topic.recorded]
    names = {topic.key for topic in recorded} | fields_in({topic.message for topic in recorded if topic.message})
    assert not names & {renaming.after for renaming in RENAMINGS}


def test_older_recordings_are_readable_and_newer_ones_are_not() -> None:
    assert MAJOR == VERSION.split(".")[0] == READABLE[-1]
    assert is_readable("1.0") and is_readable("1.7") and is_readable(VERSION)
    assert not is_readable("3.0") and not is_readable("")


@pytest.mark.parametrize("message", examples().values(), ids=lambda message: type(message).__name__)
def test_a_payload_of_an_older_version_becomes_one_of_this_version(message) -> None:
    old = message.encode().replace(f'"version":"{VERSION}"'.encode(), b'"version":"1.0"', 1)
    assert type(message).decode(converted(old, "1.0")) == message


def test_a_payload_of_this_major_version_is_unchanged() -> None:
    payload = b'{"version":"2.9", "tick":1}'
    assert converted(payload, "2.9") is payload


@pytest.mark.parametrize("payload", [b"", b"\xff", b"[1]", b'"text"', b'{"version":"3.1","tick":1}', b'{"version":7}'])
def test_a_payload_that_is_no_message_of_a_readable_version_is_unchanged(payload: bytes) -> None:
    assert converted(payload, "1.0") is payload


def test_a_payload_without_a_version_gets_one() -> None:
    assert converted(b'{"tick":1,"time":0.02}', "1.0") == f'{{"tick":1,"time":0.02,"version":"{VERSION}"}}'.encode()
