"""What was said in a match, out of the minutes of its host."""

from typing import Any

import pytest
from pydantic_core import to_json

from recordings.minutes import received_of
from schemas.bus.contract import Received, Stamp
from schemas.message import BadMessageError
from schemas.minutes import MAX_KEY, Minutes
from schemas.topics import COMMAND, MINUTES, ORDER, WORLD

KEY = "robot/cyan1/command"
ENTRY = {"key": KEY, "message": {}, "sequence": 7, "sent_ns": 11, "sim_ns": 13, "arrived_ns": 17}


def minutes(*entries: Any, **fields: Any) -> Received:
    return Received(MINUTES, MINUTES.key, to_json({"version": "1.0", "tick": 3, "entries": entries} | fields), None)


def test_messages_come_as_their_senders_sent_them():
    order = {**ENTRY, "key": "team/cyan/order", "message": "naïve", "sequence": 0}
    world = {**ENTRY, "key": "world", "message": {"tick": 3, "time": 0.06}, "arrived_ns": 0}
    assert received_of(minutes(ENTRY, order, world)) == [
        Received(COMMAND, KEY, b"{}", Stamp(7, 11, 13), 17),
        Received(ORDER, "team/cyan/order", '"naïve"'.encode(), Stamp(0, 11, 13), 17),
        Received(WORLD, "world", b'{"tick":3,"time":0.06}', Stamp(7, 11, 13), 0),
    ]


def test_what_is_no_json_and_messages_without_a_number_come_too():
    (octets,) = received_of(minutes({"key": KEY, "octets": "/w==", "sequence": 1, "sent_ns": 2, "sim_ns": -1}))
    assert octets == Received(COMMAND, KEY, b"\xff", Stamp(1, 2, -1), 0)
    (bare,) = received_of(minutes({"key": KEY, "message": 1.50, "arrived_ns": 5}))
    assert bare == Received(COMMAND, KEY, b"1.5", None, 5)


def test_keys_of_no_recorded_topic_are_passed_over():
    assert received_of(minutes({**ENTRY, "key": "robot/cyan1/sight"}, {**ENTRY, "key": "elsewhere"})) == []


ODD = {
    "no entries": minutes(entries=None),
    "tick": minutes(ENTRY, tick="soon"),
    "tick that is true": minutes(ENTRY, tick=True),
    "more fields": minutes(ENTRY, more=1),
    "other version": minutes(ENTRY, version="2.0"),
    "other version with more fields": minutes(ENTRY, version="2.0", more=1),
    "entry": minutes(3),
    "more in an entry": minutes({**ENTRY, "more": 1}),
    "no key": minutes({key: value for key, value in ENTRY.items() if key != "key"}),
    "key": minutes({**ENTRY, "key": 3}),
    "long key": minutes({**ENTRY, "key": "k" * (MAX_KEY + 1)}),
    "octets": minutes({**ENTRY, "octets": 3}),
    "octets that are none": minutes({**ENTRY, "octets": "a"}),
    "octets between others": minutes({**ENTRY, "octets": "/w*=="}),
    "sequence": minutes({**ENTRY, "sequence": -1}),
    "broken sequence": minutes({**ENTRY, "sequence": 1.5}),
    "time": minutes({**ENTRY, "sent_ns": None}),
    "list": Received(MINUTES, MINUTES.key, b"[]", None),
    "cut off": Received(MINUTES, MINUTES.key, b'{"version":"1.0","tick":3', None),
    "too long": minutes({**ENTRY, "message": "x" * Minutes.max_bytes}),
}


@pytest.mark.parametrize("odd", ODD.values(), ids=ODD)
def test_what_is_no_minutes_is_refused_with_a_reason(odd):
    with pytest.raises(BadMessageError, match="Minutes: "):
        received_of(odd)


def test_another_major_version_is_named_whatever_else_is_odd():
    with pytest.raises(BadMessageError, match=r"version 2\.0 is not spoken here"):
        received_of(ODD["other version with more fields"])


def test_a_minor_version_is_read():
    assert len(received_of(minutes(ENTRY, version="1.7"))) == 1
