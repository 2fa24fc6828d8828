"""What others sent is handed on for the record, byte for byte."""

import pytest

from schemas.bus.contract import Received, Stamp
from schemas.bus.in_process import Medium
from schemas.clock import SteppedClock
from schemas.coach import CoachOrder
from schemas.topics import COMMAND, INTAKE, ORDER
from sim_host import relay as module
from sim_host.relay import Relay

KEY = "robot/cyan1/command"


@pytest.fixture
def seat():
    return Medium().seat("friendly", SteppedClock())


@pytest.fixture
def heard(seat):
    subscription = seat.subscribe(INTAKE)
    return lambda: [received.message() for received in iter(subscription.receive, None)]


@pytest.fixture
def relay(seat, heard):
    return Relay(seat)


def command(payload: bytes, number: int) -> Received:
    return Received(COMMAND, KEY, payload, Stamp(number, 7, 8), 9)


def test_payloads_are_handed_on_as_they_came_with_what_travelled_beside_them(relay, heard):
    payloads = [b'{"answers_tick":0}', b'{"odd": \xff', b""]
    for number, payload in enumerate(payloads):
        relay.note(command(payload, number))
    relay.note(Received(COMMAND, KEY, b"from another program", None, 9))
    relay.send(1)

    (intake,) = heard()
    assert intake.tick == 1
    assert [entry.payload for entry in intake.entries] == [*payloads, b"from another program"]
    assert [(e.sequence, e.sent_ns, e.sim_ns, e.arrived_ns) for e in intake.entries] == [
        *((number, 7, 8, 9) for number in range(3)),
        (None, 0, -1, 9),
    ]


def test_a_tick_in_which_nothing_came_is_told_too(relay, heard):
    for tick in (1, 2):
        relay.send(tick)
    assert [(intake.tick, intake.entries) for intake in heard()] == [(1, []), (2, [])]


def test_a_flood_is_not_handed_on_and_the_next_tick_is(relay, heard, monkeypatch):
    monkeypatch.setattr(module, "_MOST", 10)
    for number in range(50):
        relay.note(command(b"?", number))
    relay.send(1)
    relay.note(command(b"?", 50))
    relay.send(2)
    assert [[entry.sequence for entry in intake.entries] for intake in heard()] == [list(range(10)), [50]]


def test_a_payload_longer_than_any_message_is_left_out(relay, heard):
    relay.note(command(b"x" * 70_000, 0))
    relay.note(command(b"x", 1))
    relay.send(1)
    assert [entry.sequence for intake in heard() for entry in intake.entries] == [1]


def test_much_of_one_tick_goes_in_several_messages(relay, heard, monkeypatch):
    monkeypatch.setattr(module, "_AT_ONCE", 100)
    relay.send(4)
    for number in range(5):
        relay.note(command(b"x" * 60, number))
    relay.send(5)
    messages = heard()[1:]
    assert [[entry.sequence for entry in intake.entries] for intake in messages] == [[0, 1], [2, 3], [4]]
    assert {intake.tick for intake in messages} == {5}


def test_the_host_hands_on_what_its_robots_and_coaches_say(pitch):
    told = pitch.hear(INTAKE)
    pitch.outside.publisher(ORDER, side="cyan").put(CoachOrder(sequence=1))
    pitch.ticks(3)
    keys = [sorted(entry.key for entry in intake.entries) for intake in told.all()]
    assert len(keys) == 3
    assert "team/cyan/order" in keys[0]
    robots = [COMMAND.fill(robot=name) for name in pitch.agents]
    assert keys[1] == keys[2] == sorted(robots)
