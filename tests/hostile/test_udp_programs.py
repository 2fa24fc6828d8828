"""Attacks on the port of coach programs, one datagram after another: forgeries, floods, guesses, replays."""

import json
import random
from typing import Any

import pytest

from coach_gateway.access.roles import Role
from coach_gateway.udp.coach_programs import MOST, MOST_OF_A_SIDE, CoachPrograms, DatagramResult
from coach_gateway.udp.protocol import MAX_BYTES
from coach_gateway.udp.session import AT_ONCE
from coach_gateway.udp.strangers import ALL_AT_ONCE, NETWORK_AT_ONCE, SOURCE_AT_ONCE, short_refusal
from schemas.side import Side

TOKENS = {"": Role.SPECTATOR, "cyan-token": Role.CYAN, "magenta-token": Role.MAGENTA, "referee-token": Role.REFEREE}
ROBOTS = {"cyan1": Side.CYAN, "magenta1": Side.MAGENTA}


class Gate:
    """The sessions of a gateway, with the lines that it logs."""

    def __init__(self) -> None:
        self.logged: list[str] = []
        self.programs = CoachPrograms(TOKENS.get, 0.0, self.logged.append)
        self.now = 0.0

    def receive(self, data: bytes, host: str, port: int = 1) -> DatagramResult:
        return self.programs.handle(data, (host, port), self.now, ROBOTS)

    def begin(self, role: str, host: str, port: int = 1) -> str:
        """A session; empty where it was refused."""
        ack = self.receive(datagram("hello", 1, token=f"{role}-token"), host, port).ack
        return (ack.session or "") if ack is not None else ""


def datagram(kind: str, sequence: int, **words: Any) -> bytes:
    return json.dumps({"kind": kind, "sequence": sequence, **words}).encode()


@pytest.fixture
def gate() -> Gate:
    return Gate()


def noise(number: int) -> bytes:
    source = random.Random(number)
    return source.choice(
        (
            source.randbytes(source.randrange(200)),
            datagram("hello", 1, token=f"guess {number}"),
            datagram("order", number + 1, session="guessed", order={"mode": "hold"}),
            datagram("hello", 1, token="cyan-token")[: source.randrange(50)],
            b"[" * source.randrange(9000),
            b"{" + b'"a":{' * source.randrange(1500),
        )
    )


def test_a_flood_of_one_source_keeps_no_other_of_its_machine_out(gate: Gate) -> None:
    """Formerly all strangers had one limit: 50 datagrams of one of them kept the rest out."""
    for number in range(5000):
        gate.receive(noise(number), "192.0.2.1", 666)
    assert gate.begin("cyan", "192.0.2.1", 7) and gate.begin("magenta", "192.0.2.2")
    assert gate.programs.left_out == 5000 - SOURCE_AT_ONCE


def test_a_flood_from_all_ports_of_one_machine_keeps_no_other_machine_out(gate: Gate) -> None:
    for port in range(5000):
        gate.receive(noise(port), "192.0.2.1", port)
    assert gate.begin("referee", "192.0.2.2")
    assert gate.programs.left_out == 5000 - NETWORK_AT_ONCE


def test_ten_thousand_forged_sources_cost_a_bounded_effort_and_disturb_no_session(gate: Gate) -> None:
    key = gate.begin("cyan", "192.0.2.1")
    forged = [f"10.{number // 65536}.{number // 256 % 256}.{number % 256}" for number in range(10_000)]
    replies = [gate.receive(noise(number), host) for number, host in enumerate(forged)]
    assert sum(reply.ack is not None for reply in replies) < ALL_AT_ONCE
    order = gate.receive(datagram("order", 2, session=key, order={"mode": "hold"}), "192.0.2.1")
    assert order.request is not None
    assert len(gate.programs.sessions) == 1
    assert len(gate.logged) <= 20  # a line for each network and kind, and never many at once
    gate.now = 5.0
    assert gate.begin("magenta", "192.0.2.2")


def test_datagrams_with_the_forged_address_of_a_program_take_none_of_its_rate(gate: Gate) -> None:
    """Formerly 200 of them kept the program's own datagrams out, stops included."""
    key = gate.begin("referee", "192.0.2.1")
    for number in range(1000):
        gate.receive(noise(number), "192.0.2.1")
    stop = gate.receive(datagram("action", 2, session=key, action={"action": "stop"}), "192.0.2.1")
    assert stop.request is not None and stop.request.is_stop
    assert gate.programs.sessions[("192.0.2.1", 1)].key == key


def test_a_program_that_floods_is_held_back_alone(gate: Gate) -> None:
    cyan, referee = gate.begin("cyan", "192.0.2.1"), gate.begin("referee", "192.0.2.1", 2)
    done = [gate.receive(datagram("alive", number, session=cyan), "192.0.2.1") for number in range(2, 100_000)]
    assert sum(result.ack is not None for result in done) == AT_ONCE
    assert gate.receive(datagram("alive", 2, session=referee), "192.0.2.1", 2).ack is not None
    assert gate.logged == ["coach programs: datagrams beyond the rate limit from 192.0.2.1; further ones are counted"]


def test_one_sides_programs_leave_room_for_the_other_side_and_the_referee(gate: Gate) -> None:
    begun = 0
    for port in range(400):
        gate.now += 0.1
        begun += bool(gate.begin("cyan", "192.0.2.1", port))
    assert begun == MOST_OF_A_SIDE < MOST
    assert all(gate.begin("magenta", "192.0.2.2", port) for port in range(MOST_OF_A_SIDE))
    assert gate.begin("referee", "192.0.2.3")


def test_guesses_are_read_so_often_and_no_more_however_many_ports_make_them(gate: Gate) -> None:
    checked: list[str] = []
    gate.programs = CoachPrograms(lambda token: checked.append(token), 0.0, gate.logged.append)  # type: ignore[func-returns-value]
    for second in range(10):
        gate.now = float(second)
        for port in range(1000):
            gate.receive(datagram("hello", 1, token=f"guess {port}"), "192.0.2.1", port)
    assert len(checked) <= 300
    assert gate.logged[0] == (
        "coach programs: refused hellos from 192.0.2.1 (unknown token; use that of a side's coach or of the referee); "
        "further ones are counted"
    )


def test_what_was_captured_is_done_once_whoever_sends_it_again(gate: Gate) -> None:
    key = gate.begin("cyan", "192.0.2.1")
    orders = [datagram("order", number, session=key, order={"mode": "hold"}) for number in (2, 3)]
    assert all(gate.receive(order, "192.0.2.1").request is not None for order in orders)
    for host, port in (("192.0.2.1", 1), ("192.0.2.66", 1), ("192.0.2.1", 66)):
        for order in orders:
            assert gate.receive(order, host, port).request is None
    gate.receive(datagram("bye", 4, session=key), "192.0.2.1")
    gate.begin("cyan", "192.0.2.1")  # the next session has another key
    assert all(gate.receive(order, "192.0.2.1").request is None for order in orders)


FOREIGN = [
    ("order", {"side": "magenta", "order": {"mode": "hold"}}),
    ("order", {"order": {"mode": "hold"}, "side": "both"}),
    ("match_mode", {"mode": "stop", "side": "magenta"}),
    ("match_mode", {"mode": "our_penalty"}),
    ("match_mode", {"mode": -1}),
    ("match_mode", {"mode": 10**30}),
    ("action", {"action": {"action": "goal", "side": "cyan"}}),
    ("action", {"action": {"action": "repair", "robot": "magenta1"}}),
    ("action", {"action": {"action": "repair", "robot": "**"}}),
    ("action", {"action": {"action": "stop", "source": "league's referee box"}}),
    ("order", {"order": {"mode": "hold", "max_speed": float("nan")}}),
    ("order", {"order": {"mode": "hold", "max_speed": float("inf")}}),
    ("events", {"since": -1}),
    ("hello", {"token": "cyan-token", "rate": 1e9}),
    ("hello", {"token": "cyan-token", "name": "x\n\x1b[2J"}),
]


@pytest.mark.parametrize(("kind", "words"), FOREIGN)
def test_a_coach_commands_nothing_that_is_not_its_own(gate: Gate, kind: str, words: dict[str, Any]) -> None:
    key = gate.begin("cyan", "192.0.2.1")
    session = {"session": key} if kind != "hello" else {}
    result = gate.receive(datagram(kind, 2, **session, **words), "192.0.2.1")
    assert result.request is None and result.ack is not None and not result.ack.accepted
    assert "\n" not in result.ack.reason and len(result.ack.reason) <= 300


def test_no_refusal_to_a_stranger_is_longer_than_its_datagram(gate: Gate) -> None:
    longest = [b"", b"{}", b"x" * MAX_BYTES, b"x" * 60_000, datagram("hello", 1, token="wrong", name="ü" * 40)]
    for number, data in enumerate([*longest, *map(noise, range(300))]):
        gate.now += 1.0
        ack = gate.receive(data, f"192.0.2.{number % 250}", number).ack
        assert ack is not None and not ack.accepted
        refusal = short_refusal(ack, len(data))
        if refusal is not None:
            assert len(refusal) <= len(data)
            content = json.loads(refusal)
            assert content["accepted"] is False and ack.reason.startswith(content["reason"])
    typical = datagram("hello", 1, token="x" * 22, name="bench", rate=20)
    assert b'"reason":"unknown token' in (short_refusal(ack_of(gate, typical), len(typical)) or b"")


def ack_of(gate: Gate, data: bytes) -> Any:
    return gate.receive(data, "192.0.2.251").ack
