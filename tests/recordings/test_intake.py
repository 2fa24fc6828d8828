"""What robots and coaches sent, out of what the host handed on."""

from typing import Any

import pytest
from pydantic_core import to_json

from recordings.intake import received_of
from schemas.bus.contract import Received, Stamp
from schemas.intake import MAX_KEY, Intake
from schemas.message import BadMessageError
from schemas.topics import COMMAND, INTAKE, ORDER

KEY = "robot/cyan1/command"
ENTRY = {"key": KEY, "text": "{}", "sequence": 7, "sent_ns": 11, "sim_ns": 13, "arrived_ns": 17}


def intake(*entries: Any, **fields: Any) -> Received:
    return Received(INTAKE, "host/intake", to_json({"version": "1.0", "tick": 3, "entries": entries} | fields), None)


def test_messages_come_as_their_senders_sent_them():
    order = {**ENTRY, "key": "team/cyan/order", "text": "naïve", "sequence": 0}
    assert received_of(intake(ENTRY, order)) == [
        Received(COMMAND, KEY, b"{}", Stamp(7, 11, 13), 17),
        Received(ORDER, "team/cyan/order", "naïve".encode(), Stamp(0, 11, 13), 17),
    ]


def test_bytes_that_are_no_text_and_messages_without_a_number_come_too():
    (octets,) = received_of(intake({"key": KEY, "octets": "/w==", "sequence": 1, "sent_ns": 2, "sim_ns": -1}))
    assert octets == Received(COMMAND, KEY, b"\xff", Stamp(1, 2, -1), 0)
    (bare,) = received_of(intake({"key": KEY, "text": "x", "arrived_ns": 5}))
    assert bare == Received(COMMAND, KEY, b"x", None, 5)


def test_keys_of_no_recorded_topic_are_passed_over():
    assert received_of(intake({**ENTRY, "key": "world"}, {**ENTRY, "key": "elsewhere"})) == []


ODD = {
    "no entries": intake(entries=None),
    "tick": intake(ENTRY, tick="soon"),
    "tick that is true": intake(ENTRY, tick=True),
    "more fields": intake(ENTRY, more=1),
    "other version": intake(ENTRY, version="2.0"),
    "minor version": intake(ENTRY, version="1.7"),
    "entry": intake(3),
    "more in an entry": intake({**ENTRY, "more": 1}),
    "no key": intake({key: value for key, value in ENTRY.items() if key != "key"}),
    "key": intake({**ENTRY, "key": 3}),
    "long key": intake({**ENTRY, "key": "k" * (MAX_KEY + 1)}),
    "text": intake({**ENTRY, "text": 3}),
    "no text": intake({**ENTRY, "text": None}),
    "sequence": intake({**ENTRY, "sequence": -1}),
    "broken sequence": intake({**ENTRY, "sequence": 1.5}),
    "whole sequence": intake({**ENTRY, "sequence": 1.0}),
    "sequence in words": intake({**ENTRY, "sequence": "7"}),
    "time": intake({**ENTRY, "sent_ns": None}),
    "list": Received(INTAKE, "host/intake", b"[]", None),
    "no JSON": Received(INTAKE, "host/intake", b'{"version":"1.0","tick":3', None),
    "too long": intake({**ENTRY, "text": "x" * Intake.max_bytes}),
}


@pytest.mark.parametrize("odd", ODD.values(), ids=ODD)
def test_the_short_way_takes_nothing_that_the_message_refuses_and_reads_nothing_otherwise(odd):
    try:
        message: Intake = odd.message()
    except BadMessageError:
        with pytest.raises(BadMessageError):
            received_of(odd)
        return
    assert [(one.key, one.payload, one.stamp) for one in received_of(odd)] == [
        (entry.key, entry.payload, Stamp(entry.sequence, entry.sent_ns, entry.sim_ns)) for entry in message.entries
    ]
