"""Minutes hold what is recorded of several ticks, byte for byte; they can be kept of anything that is said."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from schemas.bus import minutes as module
from schemas.bus.contract import Received, Stamp
from schemas.bus.in_process import Medium
from schemas.bus.minutes import MinuteKeeper
from schemas.clock import SteppedClock
from schemas.minutes import Entry, Minutes, payload_fields, read_minutes, write_minutes
from schemas.topics import COMMAND, EVENT, MINUTES, SIGHT, WORLD

KEY = "robot/cyan1/command"


@pytest.fixture
def seat():
    return Medium().seat("friendly", SteppedClock())


@pytest.fixture
def heard(seat):
    """What has been sent: tick, and entries, of each."""
    subscription = seat.subscribe(MINUTES)

    def hear():
        sent = [received.payload for received in iter(subscription.receive, None)]
        return [(Minutes.decode(payload).tick, read_minutes(payload)) for payload in sent]

    return hear


@pytest.fixture
def keeper(seat, heard):
    return MinuteKeeper(seat)


def command(payload: bytes, number: int) -> Received:
    return Received(COMMAND, KEY, payload, Stamp(number, 7, 8), 9)


def numbers(heard) -> list[list[int | None]]:
    return [[entry.sequence for entry in entries] for _, entries in heard()]


def test_what_others_say_is_noted_as_it_came_with_what_travelled_beside_it(keeper, heard):
    payloads = [b'{"answers_tick":0}', b'{"odd": \xff', b"", b"null", b' {"spaced" : 1.50}', '{"naïve":"é"}'.encode()]
    for number, payload in enumerate(payloads):
        keeper.note(command(payload, number))
    keeper.note(Received(COMMAND, KEY, b"from another program", None, 9))
    keeper.end_tick(1)
    keeper.send()

    ((tick, entries),) = heard()
    assert tick == 1
    assert [entry.payload for entry in entries] == [*payloads, b"from another program"]
    assert [(e.key, e.sequence, e.sent_ns, e.sim_ns, e.arrived_ns) for e in entries] == [
        *((KEY, number, 7, 8, 9) for number in range(len(payloads))),
        (KEY, None, 0, -1, 9),
    ]


def test_what_the_host_says_goes_out_at_once_and_is_noted_if_it_is_recorded(keeper, heard, seat):
    world, sight = keeper.publisher(WORLD), keeper.publisher(SIGHT, robot="cyan1")
    worlds, sights = seat.subscribe(WORLD), seat.subscribe(SIGHT)
    stamps = [world.put_payload(b'{"tick":1}'), sight.put_payload(b"{}"), world.put_payload(b'{"tick":2}')]

    assert [received.stamp for received in iter(worlds.receive, None)] == [stamps[0], stamps[2]]
    assert sights.receive() is not None
    keeper.send()
    ((_, entries),) = heard()
    assert [(entry.key, entry.payload) for entry in entries] == [("world", b'{"tick":1}'), ("world", b'{"tick":2}')]
    assert [Stamp(entry.sequence, entry.sent_ns, entry.sim_ns) for entry in entries] == [stamps[0], stamps[2]]


def test_several_ticks_go_in_one_message(keeper, heard):
    event = keeper.publisher(EVENT)
    for tick in range(1, 20):
        event.put_payload(b"%d" % tick)
        keeper.end_tick(tick)
    assert [(tick, len(entries)) for tick, entries in heard()] == [(8, 8), (16, 8)]


def test_ticks_that_take_long_wait_for_fewer(keeper, heard, seat):
    for tick in (1, 2):
        keeper.note(command(b"{}", tick))
        seat.clock.sleep_until(seat.clock.now() + 0.1)
        keeper.end_tick(tick)
    assert numbers(heard) == [[1, 2]]


def test_what_was_noted_does_not_wait_as_long_as_a_tick_may_take(keeper, heard, seat):
    keeper.note(command(b"{}", 3))
    keeper.send_if_due()
    assert numbers(heard) == []
    seat.clock.sleep_until(seat.clock.now() + 0.2)
    keeper.send_if_due()
    seat.clock.sleep_until(seat.clock.now() + 0.2)
    keeper.send_if_due()
    assert numbers(heard) == [[3]]


def test_a_flood_is_not_noted_and_the_next_tick_is(keeper, heard, monkeypatch):
    monkeypatch.setattr(module, "_MOST", 10)
    for number in range(50):
        keeper.note(command(b"?", number))
    keeper.end_tick(1)
    keeper.note(command(b"?", 50))
    keeper.send()
    assert numbers(heard) == [[*range(10), 50]]


def test_a_payload_longer_than_any_message_is_left_out(keeper, heard):
    keeper.note(command(b"x" * 70_000, 0))
    keeper.note(command(b"x", 1))
    keeper.send()
    assert numbers(heard) == [[1]]


def test_much_at_once_goes_in_several_messages(keeper, heard, monkeypatch):
    monkeypatch.setattr(module, "_AT_ONCE", 100)
    keeper.end_tick(4)
    for number in range(5):
        keeper.note(command(b"x" * 60, number))
    keeper.send()
    messages = heard()
    assert [[entry.sequence for entry in entries] for _, entries in messages] == [[0, 1], [2, 3], [4]]
    assert {tick for tick, _ in messages} == {4}


@given(st.binary(max_size=40) | st.text(max_size=20).map(str.encode) | st.just(b"[" * 5000 + b"]" * 5000))
def test_any_payload_comes_out_as_it_went_in_and_leaves_the_minutes_whole(payload):
    written = write_minutes(3, [Entry("world", **payload_fields(payload))])
    assert Minutes.decode(written).tick == 3
    (entry,) = read_minutes(written)
    assert entry.payload == payload
