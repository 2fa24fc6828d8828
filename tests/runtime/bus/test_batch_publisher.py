"""Batches hold what is recorded of several ticks, byte for byte, and the newest of them can be asked for again."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from runtime.bus import batch_publisher as module
from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import NoReplyError, ReceivedMessage, Stamp
from schemas.messages.command import Command
from schemas.messages.record_batch import BatchEntry, RecordBatch, RecordBatchesReply, RecordBatchesRequest
from schemas.topics import COMMAND, EVENT, RECORD_BATCH, RECORD_BATCHES, SIGHT, WORLD
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock

KEY = "robot/cyan1/command"


@pytest.fixture
def seat():
    return SharedState().open_bus("friendly", SteppedClock())


@pytest.fixture
def heard(seat):
    """What has been sent: tick, and entries, of each."""
    subscription = seat.subscribe(RECORD_BATCH)

    def hear():
        sent = [received.payload for received in iter(subscription.receive, None)]
        return [(RecordBatch.decode(payload).tick, RecordBatch.decode(payload).entries) for payload in sent]

    return hear


@pytest.fixture
def batches(seat, heard):
    return BatchPublisher(seat)


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


def test_messages_of_the_host_are_published_at_once_and_added_to_the_batch_if_recorded(batches, heard, seat):
    world, sight = batches.publisher(WORLD), batches.publisher(SIGHT, robot="cyan1")
    worlds, sights = seat.subscribe(WORLD), seat.subscribe(SIGHT)
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


def test_ticks_that_take_long_wait_for_fewer(batches, heard, seat):
    for tick in (1, 2):
        batches.add_received(command(b"{}", tick))
        seat.clock.sleep_until(seat.clock.now() + 0.1)
        batches.end_tick(tick)
    assert numbers(heard) == [[1, 2]]


def test_what_was_noted_does_not_wait_as_long_as_a_tick_may_take(batches, heard, seat):
    batches.add_received(command(b"{}", 3))
    batches.send_if_due()
    assert numbers(heard) == []
    seat.clock.sleep_until(seat.clock.now() + 0.2)
    batches.send_if_due()
    seat.clock.sleep_until(seat.clock.now() + 0.2)
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


def publish(batches, count: int, size: int = 10) -> None:
    for number in range(count):
        batches.add_received(command(b"x" * size, number))
        batches.send()


def ask(batches, seat, **words):
    """Ask for batches: what the host's reply holds, and the numbers of the batches in it."""
    answer = seat.query(RECORD_BATCHES, RecordBatchesRequest(**words))
    batches.process()
    reply = RecordBatchesReply.decode(answer.payload(0.0))
    return reply, [RecordBatch.decode(bytes(batch)).number for batch in reply.batches]


def test_batches_are_numbered_and_name_their_host(batches, seat):
    listener = seat.subscribe(RECORD_BATCH)
    publish(batches, 3)
    came = [RecordBatch.decode(received.payload) for received in iter(listener.receive, None)]
    assert [batch.number for batch in came] == [0, 1, 2]
    seat.clock.sleep_until(3.0)
    other = BatchPublisher(seat)
    other.send()
    again = RecordBatch.decode(listener.receive().payload)
    assert again.number == 0
    assert again.stream not in {batch.stream for batch in came}


def test_a_recorder_that_asks_is_given_the_very_bytes_again(batches, seat):
    listener = seat.subscribe(RECORD_BATCH)
    publish(batches, 5)
    sent = [received.payload for received in iter(listener.receive, None)]
    reply, numbers = ask(batches, seat, first=1, last=3)
    assert numbers == [1, 2, 3]
    assert [bytes(batch) for batch in reply.batches] == sent[1:4]
    assert reply.oldest == 0


def test_without_a_last_number_all_newer_batches_are_given(batches, seat):
    publish(batches, 5)
    assert ask(batches, seat, first=3)[1] == [3, 4]
    assert ask(batches, seat, first=5)[1] == []
    assert ask(batches, seat, first=10**40)[1] == []
    assert ask(batches, seat, first=2, last=1)[1] == []


def test_a_host_without_batches_replies_with_none(batches, seat):
    reply, numbers = ask(batches, seat, first=0)
    assert (reply.oldest, numbers) == (0, [])


def test_the_host_keeps_so_many_batches_and_tells_which_is_the_oldest(batches, seat, monkeypatch):
    monkeypatch.setattr(module, "KEPT_BATCHES", 4)
    publish(batches, 10)
    reply, numbers = ask(batches, seat, first=0)
    assert (reply.oldest, numbers) == (6, [6, 7, 8, 9])
    assert ask(batches, seat, first=0, last=5)[1] == []


def test_the_host_keeps_no_more_bytes_than_a_limit(batches, seat, monkeypatch):
    monkeypatch.setattr(module, "KEPT_BYTES", 4000)
    publish(batches, 10, size=1000)
    reply, numbers = ask(batches, seat, first=0)
    assert numbers == [reply.oldest, 8, 9][-len(numbers) :]
    assert 1 <= len(numbers) <= 3
    publish(batches, 1, size=5000)
    assert ask(batches, seat, first=0)[1] == [10]


def test_batches_from_before_a_time_are_left_out(batches, seat):
    publish(batches, 3)
    seat.clock.sleep_until(seat.clock.now() + 1.0)
    since_ns = seat.clock.unix_ns()
    publish(batches, 2)
    reply, numbers = ask(batches, seat, first=0, since_ns=since_ns)
    assert (reply.oldest, numbers) == (3, [3, 4])
    assert ask(batches, seat, first=0, since_ns=10**19)[0].oldest == 5


def test_a_reply_holds_at_least_one_batch_and_no_more_bytes_than_a_limit(batches, seat, monkeypatch):
    monkeypatch.setattr(module, "_MAX_REPLY_BYTES", 2500)
    publish(batches, 6, size=700)
    numbers = ask(batches, seat, first=0)[1]
    assert numbers == list(range(len(numbers)))
    assert 1 < len(numbers) < 6
    assert ask(batches, seat, first=numbers[-1] + 1)[1][0] == numbers[-1] + 1
    monkeypatch.setattr(module, "_MAX_REPLY_BYTES", 1)
    assert ask(batches, seat, first=2)[1] == [2]


def test_an_invalid_request_is_refused_with_the_reason(seat):
    invalid = []
    batches = BatchPublisher(seat, lambda *words: invalid.append(words))
    answer = seat.query(RECORD_BATCHES, Command(answers_tick=3))
    batches.process()
    with pytest.raises(NoReplyError, match="RecordBatchesRequest"):
        answer.payload(0.0)
    assert [key for key, *_ in invalid] == ["host/record_batches"]


def test_questions_without_end_do_not_hold_the_host(batches, seat):
    publish(batches, 1)
    answers = [seat.query(RECORD_BATCHES, RecordBatchesRequest(first=0)) for _ in range(100)]
    batches.process()
    with pytest.raises(NoReplyError):
        answers[-1].payload(0.0)
    assert answers[0].payload(0.0)


@given(st.binary(max_size=40) | st.text(max_size=20).map(str.encode) | st.just(b"[" * 5000 + b"]" * 5000))
def test_any_payload_comes_out_as_it_went_in_and_leaves_the_batch_whole(payload):
    written = RecordBatch(stream=1, number=2, tick=3, sent_ns=4, entries=[BatchEntry.of("world", payload)]).encode()
    assert RecordBatch.decode(written).tick == 3
    (entry,) = RecordBatch.decode(written).entries
    assert entry.payload == payload
