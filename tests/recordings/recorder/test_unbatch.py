"""The messages in a host's batch."""

from typing import Any

import pytest

from recordings.recorder.batch_reader import Unbatcher
from runtime.bus.contract import ReceivedMessage, Stamp
from schemas.messages.record_batch import RecordBatch
from schemas.topics import COMMAND, ORDER, SIGHT, WORLD
from schemas.wire.message import BadMessageError
from schemas.wire.part import encode

KEY = "robot/cyan1/command"
ENTRY = {"key": KEY, "message": {}, "sequence": 7, "sent_ns": 11, "sim_ns": 13, "arrived_ns": 17}
HEAD = {"version": "2.0", "stream": 5, "number": 0, "tick": 3, "sent_ns": 9}


def batch(*entries: Any, **fields: Any) -> bytes:
    return encode({**HEAD, "entries": entries} | fields)


def messages(payload: bytes, **wanted: bool) -> list[ReceivedMessage]:
    return [received for _, received in Unbatcher(**wanted).messages_of(RecordBatch.decode(payload))]


def test_messages_come_as_their_senders_sent_them():
    order = {**ENTRY, "key": "team/cyan/order", "message": "naïve", "sequence": 0}
    world = {**ENTRY, "key": "world", "message": {"tick": 3, "time": 0.06}, "arrived_ns": 0}
    assert messages(batch(ENTRY, order, world)) == [
        ReceivedMessage(COMMAND, KEY, b"{}", Stamp(7, 11, 13), 17),
        ReceivedMessage(ORDER, "team/cyan/order", '"naïve"'.encode(), Stamp(0, 11, 13), 17),
        ReceivedMessage(WORLD, "world", b'{"tick":3,"time":0.06}', Stamp(7, 11, 13), 0),
    ]


def test_what_is_no_json_and_messages_without_a_number_come_too():
    (octets,) = messages(batch({"key": KEY, "octets": "/w==", "sequence": 1, "sent_ns": 2, "sim_ns": -1}))
    assert octets == ReceivedMessage(COMMAND, KEY, b"\xff", Stamp(1, 2, -1), 0)
    (bare,) = messages(batch({"key": KEY, "message": 1.50, "arrived_ns": 5}))
    assert bare == ReceivedMessage(COMMAND, KEY, b"1.5", None, 5)


def test_keys_of_no_recorded_topic_are_passed_over():
    assert messages(batch({**ENTRY, "key": "robot/cyan1/hand"}, {**ENTRY, "key": "elsewhere"})) == []


def test_sights_are_taken_from_a_batch_on_request_only():
    payload = batch({**ENTRY, "key": "robot/cyan1/sight"})
    assert messages(payload) == []
    assert messages(payload, sights=True) == [ReceivedMessage(SIGHT, "robot/cyan1/sight", b"{}", Stamp(7, 11, 13), 17)]


def test_the_log_time_is_the_hosts_whatever_a_sender_claims_and_never_runs_backward():
    own = [{"key": "world", "message": {}, "sequence": tick, "sim_ns": 20 * tick} for tick in range(4)]
    ahead = {**ENTRY, "sim_ns": 10**18, "arrived_sim_ns": 20}
    late = {**ENTRY, "sim_ns": 0, "arrived_sim_ns": 40}
    bare = {"key": KEY, "message": {}, "arrived_sim_ns": 60}
    unbatcher = Unbatcher()
    first = unbatcher.messages_of(RecordBatch.decode(batch(own[0], own[1], ahead, own[2], late)))
    second = unbatcher.messages_of(RecordBatch.decode(batch({**ENTRY, "sim_ns": 10**18}, own[0], own[3], bare)))
    assert [log_ns for log_ns, _ in first + second] == [0, 20, 20, 40, 40, 40, 40, 60, 60]


@pytest.mark.parametrize("octets", [3, "a", "/w*=="])
def test_octets_that_are_none_are_refused_with_a_reason(octets):
    with pytest.raises(BadMessageError, match="RecordBatch: "):
        messages(batch({**ENTRY, "octets": octets}))
