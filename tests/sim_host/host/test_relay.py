"""What others sent is handed on for the record, byte for byte."""

from schemas.coach import CoachOrder
from schemas.command import Command
from schemas.topics import COMMAND, INTAKE, ORDER
from sim_host import relay


def test_commands_and_orders_are_handed_on_with_their_numbers(pitch):
    heard = pitch.hear(INTAKE)
    writer = pitch.outside.publisher(COMMAND, robot="cyan1")
    payloads = [Command(answers_tick=0).encode(), b'{"odd": \xff', b""]
    for payload in payloads:
        writer.put_payload(payload)
    pitch.outside.publisher(ORDER, side="cyan").put(CoachOrder(sequence=1))
    pitch.ticks(1)

    (intake,) = heard.all()
    mine = [entry for entry in intake.entries if entry.key == "robot/cyan1/command" and entry.payload in payloads]
    assert [(entry.payload, entry.sequence) for entry in mine] == [(p, n) for n, p in enumerate(payloads)]
    assert [entry.key for entry in intake.entries if entry not in mine] == ["team/cyan/order"]
    assert intake.tick == 1


def test_a_tick_in_which_nothing_came_is_told_too(pitch):
    heard = pitch.hear(INTAKE)
    pitch.ticks(3)
    assert [(intake.tick, intake.entries) for intake in heard.all()] == [(1, []), (2, []), (3, [])]


def test_a_flood_is_not_handed_on_and_shows_as_a_gap(pitch, monkeypatch):
    monkeypatch.setattr(relay, "_MOST", 10)
    heard = pitch.hear(INTAKE)
    writer = pitch.outside.publisher(COMMAND, robot="cyan1")
    for _ in range(50):
        writer.put_payload(b"?")
    pitch.ticks(1)
    writer.put_payload(b"?")
    pitch.ticks(1)
    assert [[entry.sequence for entry in intake.entries] for intake in heard.all()] == [list(range(10)), [50]]


def test_much_of_one_tick_goes_in_several_messages(pitch, monkeypatch):
    monkeypatch.setattr(relay, "_AT_ONCE", 100)
    heard = pitch.hear(INTAKE)
    writer = pitch.outside.publisher(COMMAND, robot="cyan1")
    for number in range(5):
        writer.put_payload(b"x" * 60 + b"%d" % number)
    pitch.ticks(1)
    messages = heard.all()
    assert len(messages) == 3
    assert [entry.sequence for intake in messages for entry in intake.entries] == list(range(5))
