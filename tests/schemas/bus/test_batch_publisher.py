"""Record batches hold what is recorded of several ticks, byte for byte; they can be kept of anything that is said."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from schemas.bus.batch_publisher import BatchPublisher
from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.bus.in_process_bus import Medium
from schemas.messages.record_batch import RawEntry, RecordBatch, decode_batch, encode_batch, payload_fields
from schemas.process.clock import SteppedClock
from schemas.topics import COMMAND, EVENT, RECORD_BATCH, SIGHT, WORLD

KEY = "robot/cyan1/command"


@pytest.fixture
def bus():
    return Medium().open_bus("friendly", SteppedClock())


@pytest.fixture
def heard(bus):
    """What has been sent: tick, and entries, of each."""
    subscription = bus.subscribe(RECORD_BATCH)

    def hear():
        sent = [received.payload for received in iter(subscription.receive, None)]
        return [(RecordBatch.decode(payload).tick, decode_batch(payload)) for payload in sent]

    return hear


@pytest.fixture
def batches(bus, heard):
    return BatchPublisher(bus)


def command(payload: bytes, number: int) -> ReceivedMessage:
    return ReceivedMessage(COMMAND, KEY, payload, Stamp(number, 7, 8), 9)


def numbers(heard) -> list[list[int | None]]:
    return [[entry.sequence for entry in entries] for _, entries in heard()]


def test_what_others_say_is_noted_as_it_came_with_what_travelled_beside_it(batches, heard):
    payloads = [b'{"answers_tick":0}', b'{"odd": \xff', b"", b"null", b' {"spaced" : 1.50}', '{"naïve":"é"}'.encode()]
    for number, payload in enumerate(payloads):
        batches.add_received(command(payload, number))
    batches.add_received(ReceivedMessage(COMMAND, KEY, b"from another program", None, 9))
    batches.end_tick(1)
    batches.send()

    ((tick, entries),) = heard()
    assert tick == 1
    assert [entry.payload for entry in entries] == [*payloads, b"from another program"]
    assert [(e.key, e.sequence, e.sent_ns, e.sim_ns, e.arrived_ns) for e in entries] == [
        *((KEY, number, 7, 8, 9) for number in range(len(payloads))),
        (KEY, None, 0, -1, 9),
    ]


def test_what_the_host_says_goes_out_at_once_and_is_noted_if_it_is_recorded(batches, heard, bus):
    world, sight = batches.publisher(WORLD), batches.publisher(SIGHT, robot="cyan1")
    worlds, sights = bus.subscribe(WORLD), bus.subscribe(SIGHT)
    stamps = [world.put_payload(b'{"tick":1}'), sight.put_payload(b"{}"), world.put_payload(b'{"tick":2}')]

    assert [received.stamp for received in iter(worlds.receive, None)] == [stamps[0], stamps[2]]
    assert sights.receive() is not None
    batches.send()
    ((_, entries),) = heard()
    assert [(entry.key, entry.payload) for entry in entries] == [("world", b'{"tick":1}'), ("world", b'{"tick":2}')]
    assert [Stamp(entry.sequence, entry.sent_ns, entry.sim_ns) for entry in entries] == [stamps[0], stamps[2]]


def test_several_ticks_go_in_one_message(batches, heard):
    event = batches.publisher(EVENT)
    for tick in range(1, 20):
        event.put_payload(b"%d" % tick)
        batches.end_tick(tick)
    assert [(tick, len(entries)) for tick, entries in heard()] == [(8, 8), (16, 8)]


def test_ticks_that_take_long_wait_for_fewer(batches, heard, bus):
    for tick in (1, 2):
        batches.add_received(command(b"{}", tick))
        bus.clock.sleep_until(bus.clock.now() + 0.1)
        batches.end_tick(tick)
    assert numbers(heard) == [[1, 2]]


def test_what_was_noted_does_not_wait_as_long_as_a_tick_may_take(batches, heard, bus):
    batches.add_received(command(b"{}", 3))
    batches.send_if_due()
    assert numbers(heard) == []
    bus.clock.sleep_until(bus.clock.now() + 0.2)
    batches.send_if_due()
    bus.clock.sleep_until(bus.clock.now() + 0.2)
    batches.send_if_due()
    assert numbers(heard) == [[3]]


def test_a_flood_is_not_recorded_and_the_next_tick_is(batches, heard):
    for number in range(1200):
        batches.add_received(command(b"?", number))
    batches.end_tick(1)
    batches.add_received(command(b"?", 1200))
    batches.send()
    assert numbers(heard) == [[*range(1000), 1200]]


def test_a_payload_longer_than_any_message_is_left_out(batches, heard):
    batches.add_received(command(b"x" * 70_000, 0))
    batches.add_received(command(b"x", 1))
    batches.send()
    assert numbers(heard) == [[1]]


def test_more_than_256_kib_at_once_go_in_several_messages(batches, heard):
    batches.end_tick(4)
    for number in range(11):
        batches.add_received(command(b"x" * 60_000, number))
    batches.send()
    messages = heard()
    assert [[entry.sequence for entry in entries] for _, entries in messages] == [[*range(5)], [*range(5, 10)], [10]]
    assert {tick for tick, _ in messages} == {4}


@given(st.binary(max_size=40) | st.text(max_size=20).map(str.encode) | st.just(b"[" * 5000 + b"]" * 5000))
def test_any_payload_comes_out_as_it_went_in_and_leaves_the_batch_whole(payload):
    written = encode_batch(3, [RawEntry("world", **payload_fields(payload))])
    assert RecordBatch.decode(written).tick == 3
    (entry,) = decode_batch(written)
    assert entry.payload == payload
