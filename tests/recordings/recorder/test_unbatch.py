"""What was said in a match, out of the record batches of its host."""

from typing import Any

import pytest
from pydantic_core import to_json

from recordings.recorder.unbatch import unbatch
from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.message import BadMessageError
from schemas.messages.record_batch import MAX_KEY_LENGTH, RecordBatch
from schemas.topics import COMMAND, ORDER, RECORD_BATCH, WORLD

KEY = "robot/cyan1/command"
ENTRY = {"key": KEY, "message": {}, "sequence": 7, "sent_ns": 11, "sim_ns": 13, "arrived_ns": 17}


def record_batch(*entries: Any, **fields: Any) -> ReceivedMessage:
    return ReceivedMessage(
        RECORD_BATCH, RECORD_BATCH.key, to_json({"version": "2.0", "tick": 3, "entries": entries} | fields), None
    )


def test_messages_come_as_their_senders_sent_them():
    order = {**ENTRY, "key": "team/cyan/order", "message": "naïve", "sequence": 0}
    world = {**ENTRY, "key": "world", "message": {"tick": 3, "time": 0.06}, "arrived_ns": 0}
    assert unbatch(record_batch(ENTRY, order, world)) == [
        ReceivedMessage(COMMAND, KEY, b"{}", Stamp(7, 11, 13), 17),
        ReceivedMessage(ORDER, "team/cyan/order", '"naïve"'.encode(), Stamp(0, 11, 13), 17),
        ReceivedMessage(WORLD, "world", b'{"tick":3,"time":0.06}', Stamp(7, 11, 13), 0),
    ]


def test_what_is_no_json_and_messages_without_a_number_come_too():
    (octets,) = unbatch(record_batch({"key": KEY, "octets": "/w==", "sequence": 1, "sent_ns": 2, "sim_ns": -1}))
    assert octets == ReceivedMessage(COMMAND, KEY, b"\xff", Stamp(1, 2, -1), 0)
    (bare,) = unbatch(record_batch({"key": KEY, "message": 1.50, "arrived_ns": 5}))
    assert bare == ReceivedMessage(COMMAND, KEY, b"1.5", None, 5)


def test_keys_of_no_recorded_topic_are_passed_over():
    assert unbatch(record_batch({**ENTRY, "key": "robot/cyan1/sight"}, {**ENTRY, "key": "elsewhere"})) == []


ODD = {
    "no entries": record_batch(entries=None),
    "tick": record_batch(ENTRY, tick="soon"),
    "tick that is true": record_batch(ENTRY, tick=True),
    "more fields": record_batch(ENTRY, more=1),
    "other version": record_batch(ENTRY, version="1.0"),
    "other version with more fields": record_batch(ENTRY, version="1.0", more=1),
    "entry": record_batch(3),
    "more in an entry": record_batch({**ENTRY, "more": 1}),
    "no key": record_batch({key: value for key, value in ENTRY.items() if key != "key"}),
    "key": record_batch({**ENTRY, "key": 3}),
    "long key": record_batch({**ENTRY, "key": "k" * (MAX_KEY_LENGTH + 1)}),
    "octets": record_batch({**ENTRY, "octets": 3}),
    "octets that are none": record_batch({**ENTRY, "octets": "a"}),
    "octets between others": record_batch({**ENTRY, "octets": "/w*=="}),
    "sequence": record_batch({**ENTRY, "sequence": -1}),
    "broken sequence": record_batch({**ENTRY, "sequence": 1.5}),
    "time": record_batch({**ENTRY, "sent_ns": None}),
    "list": ReceivedMessage(RECORD_BATCH, RECORD_BATCH.key, b"[]", None),
    "cut off": ReceivedMessage(RECORD_BATCH, RECORD_BATCH.key, b'{"version":"2.0","tick":3', None),
    "too long": record_batch({**ENTRY, "message": "x" * RecordBatch.max_bytes}),
}


@pytest.mark.parametrize("odd", ODD.values(), ids=ODD)
def test_what_is_no_record_batch_is_refused_with_a_reason(odd):
    with pytest.raises(BadMessageError, match="RecordBatch: "):
        unbatch(odd)


def test_another_major_version_is_named_whatever_else_is_odd():
    with pytest.raises(BadMessageError, match=r"version 1\.0 is not supported"):
        unbatch(ODD["other version with more fields"])


def test_a_minor_version_is_read():
    assert len(unbatch(record_batch(ENTRY, version="2.7"))) == 1
