"""Attacks on the page's port by WebSocket messages: bombs, floods, fragments, guessed tokens, taken seats."""

import json
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from websockets.exceptions import ConnectionClosed

from coach_gateway.access import token_checks
from coach_gateway.web import connections, door, http_protocol, pages, socket_endpoint, socket_protocol
from coach_gateway.web.protocol import MAX_BYTES
from coach_gateway.web.settings import WebSettings
from support.fake_host import FakeHost
from support.page_gateway import SOON, TOKENS, Gateway
from support.raw_client import RawClient, deflated, eventually, frame
from support.visitor import Visitor

Visit = Callable[..., Visitor]
PING, TEXT, CONTINUED = 9, 1, 0


@pytest.fixture
def gateway(gateway_of: Callable[..., Gateway], host: FakeHost, monkeypatch: pytest.MonkeyPatch) -> Gateway:
    """Addresses of loopback stand for those of other machines."""
    for module in (http_protocol, socket_protocol, socket_endpoint):
        monkeypatch.setattr(module, "client_network", lambda address: address)
    return gateway_of(pages=20, pages_per_address=10)


@pytest.fixture
def raw(gateway: Gateway) -> Iterator[RawClient]:
    """A page that has made its handshake."""
    client = RawClient(gateway.port, "127.0.0.2")
    assert b"permessage-deflate" in client.upgrade(gateway.origin, Sec_WebSocket_Extensions="permessage-deflate")
    yield client
    client.close()


@pytest.fixture
def other(gateway: Gateway) -> Iterator[Visitor]:
    """The referee at another address, whom no attack may disturb."""
    visitor = Visitor(gateway.origin, source_address=("127.0.0.9", 0))
    visitor.hear_what_is_played()
    visitor.enter("referee")
    yield visitor
    assert visitor.ask("action", action={"action": "stop"})["accepted"]
    visitor.close()


def test_a_message_that_inflates_beyond_all_measure_ends_its_connection(
    gateway: Gateway, raw: RawClient, other: Visitor
) -> None:
    raw.send(frame(deflated(bytes(100_000_000)), compressed=True))
    eventually(lambda: raw.is_closed)
    assert gateway.pages.counts["broken"] == 1


def test_many_small_messages_that_inflate_are_inflated_one_after_the_other(
    gateway: Gateway, raw: RawClient, other: Visitor, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All of one read at once would be 250 MB."""
    most = 0
    receive = socket_protocol.SocketProtocol.send_receive_event_to_app

    def noting(protocol: socket_protocol.SocketProtocol) -> None:
        nonlocal most
        receive(protocol)
        most = max(most, protocol.queue.qsize())

    monkeypatch.setattr(socket_protocol.SocketProtocol, "send_receive_event_to_app", noting)
    bomb = frame(deflated(b"x" * 250_000), compressed=True)
    sending = threading.Thread(target=raw.send, args=(bomb * 1500,))
    sending.start()
    eventually(lambda: raw.is_closed)
    sending.join(SOON)
    assert 0 < most <= socket_protocol.PIECE_BYTES // len(bomb) + 2  # and the end
    assert gateway.pages.counts["bad"] <= socket_protocol.BYTES_AT_ONCE // 250_000
    assert gateway.pages.counts["bytes"] == 1


def test_pings_without_end_are_not_answered_without_end(gateway: Gateway, raw: RawClient, other: Visitor) -> None:
    pings = frame(b"p" * 125, PING) * 1000
    for _ in range(100):
        if not raw.send(pings):
            break
    eventually(lambda: raw.is_closed)
    assert gateway.pages.counts["control frames"] == 1


FLOODS = {
    "control frames": (frame(b"p", PING) * 100, "more than 2 pings and pongs a second"),
    "frames": (frame(b"{}") * 30, "more than 0.001 frames a second"),
    "bytes": (frame(b"x" * 200) * 10, "more than 1e-06 kB a second"),
}


@pytest.mark.parametrize("kind", FLOODS)
def test_a_client_that_sends_more_than_pages_do_is_closed_with_a_reason_and_the_rest_is_not_read(
    gateway: Gateway, other: Visitor, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    monkeypatch.setattr(socket_protocol, "FRAMES_PER_S", 0.001)
    monkeypatch.setattr(socket_protocol, "FRAMES_AT_ONCE", 20.0)
    monkeypatch.setattr(socket_protocol, "BYTES_PER_S", 0.001)
    monkeypatch.setattr(socket_protocol, "BYTES_AT_ONCE", 1000.0)
    flood, reason = FLOODS[kind]
    client = RawClient(gateway.port, "127.0.0.2")
    client.upgrade(gateway.origin)
    client.send(flood)
    assert client.receive_all().endswith(reason.encode())
    assert gateway.pages.counts[kind] == 1
    assert gateway.pages.counts["bad"] <= 20
    client.close()


def test_a_client_that_was_closed_for_a_flood_is_not_back_at_once_and_others_are_let_in(
    gateway: Gateway, other: Visitor, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "FLOOD_COSTS", 1e6)
    client = RawClient(gateway.port, "127.0.0.2")
    client.upgrade(gateway.origin)
    client.send(frame(b"p", PING) * 100)
    client.receive_all()
    again = RawClient(gateway.port, "127.0.0.2")
    eventually(lambda: again.is_closed)
    assert gateway.pages.counts["connections"] == 1
    elsewhere = Visitor(gateway.origin, source_address=("127.0.0.8", 0))
    elsewhere.hear("welcome")
    for one in (client, again, elsewhere):
        one.close()


def test_a_message_of_frames_without_end_ends_its_connection(gateway: Gateway, raw: RawClient, other: Visitor) -> None:
    raw.send(frame(b"{", fin=False) + frame(b"", CONTINUED, fin=False) * 100_000)
    eventually(lambda: raw.is_closed)
    assert gateway.pages.counts["broken"] == 1


BROKEN = [
    frame(b"\xff\xfe"),
    frame(b"\xff", fin=False) + frame(b"\xfe", CONTINUED),
    frame(b"", CONTINUED),
    frame(b"x", 3),
    frame(b"x" * 126, PING),
    b"\xf1\x80" + bytes(4),
    b"\x81\x00",
    b"\x81\xff\x7f" + b"\xff" * 7 + bytes(4),
    frame(b"no deflate", compressed=True),
    b"GET / HTTP/1.1\r\n\r\n",
]


def test_frames_that_break_the_protocol_end_their_own_connection(
    gateway: Gateway, other: Visitor, capfd: pytest.CaptureFixture[str]
) -> None:
    for number, broken in enumerate(BROKEN, 1):
        client = RawClient(gateway.port, "127.0.0.2")
        client.upgrade(gateway.origin, Sec_WebSocket_Extensions="permessage-deflate")
        client.send(broken)
        eventually(lambda client=client: client.is_closed, repr(broken[:20]))
        assert gateway.pages.counts["broken"] == number, broken[:20]
        client.close()
    assert "Traceback" not in capfd.readouterr().err


DEEP = 20_000
HOSTILE = [
    "[" * DEEP + "]" * DEEP,
    '{"a":' * 10_000 + "1" + "}" * 10_000,
    '{"id": 1, "deed": "action", "action": ' + "[" * DEEP + "]" * DEEP + "}",
    '{"id": 1e999, "deed": "token"}',
    '{"id": NaN, "deed": "token"}',
    '{"id": ' + "9" * 5000 + ', "deed": "token"}',
    '{"id": 18446744073709551616, "deed": "token"}',
    '{"id": 1, "deed": "token", "token": {"$ne": ""}}',
    '{"id": 1, "deed": "token", "token": ["the-referee"]}',
    '{"id": 1, "deed": "token", "token": "' + "x" * 60_000 + '"}',
    '{"id": 1, "deed": "token", "__proto__": {"role": "referee"}}',
    '{"id": 1, "deed": "token", "role": "referee"}',
    '{"id": 1, "deed": "drive", "robot": "**", "manual": {"drive": {}}}',
    '{"id": 1, "deed": "drive", "robot": "cyan1/../magenta1", "manual": {"drive": {}}}',
    '{"id": 1, "deed": "scene", "request": {"operation": "load", "scene": "../../../etc/passwd"}}',
    '{"id": 1, "deed": "order", "side": "cyan", "order": {"point_a": {"x": Infinity, "y": 0}}}',
    json.dumps({"id": 1, "deed": "token", **{f"field{number}": number for number in range(4000)}}),
    "\ud800".encode("utf-16", "surrogatepass").decode("latin-1"),
    "x" * (MAX_BYTES + 1),
]


def test_hostile_json_is_refused_in_one_line_and_the_page_goes_on(
    gateway: Gateway, host: FakeHost, other: Visitor
) -> None:
    page = Visitor(gateway.origin, source_address=("127.0.0.2", 0))
    page.hear_what_is_played()
    for hostile in HOSTILE:
        page.send(hostile)
        reply = page.hear("reply")
        assert not reply["accepted"] and 0 < len(reply["reason"]) < 1000 and "\n" not in reply["reason"], reply
    page.close()
    assert host.asked == []
    assert len(gateway.logged) <= 2


def test_a_spectator_and_a_coach_command_nothing_that_is_not_theirs(
    gateway: Gateway, host: FakeHost, other: Visitor
) -> None:
    page = Visitor(gateway.origin, source_address=("127.0.0.2", 0))
    page.hear_what_is_played()
    foreign = [
        ("action", {"action": {"action": "stop"}}),
        ("action", {"action": {"action": "goal", "side": "cyan"}}),
        ("action", {"action": {"action": "repair", "robot": "magenta1"}}),
        ("order", {"side": "magenta", "order": {"mode": "hold"}}),
        ("drive", {"robot": "magenta1", "manual": {"drive": {"vx": 1.0}}}),
        ("scene", {"request": {"operation": "reset"}}),
        ("parameters", {"request": {"operation": "set", "values": {"radio.loss": 1.0}}}),
        ("referee_seat", {"operation": "take_over"}),
    ]
    for role in ("spectator", "cyan"):
        if role == "cyan":
            page.enter("cyan")
        for deed, content in foreign:
            reply = page.ask(deed, **content)
            assert not reply["accepted"], (role, deed, reply)
    assert host.asked == [] and host.given_orders == [] and host.hands.receive() is None
    page.close()


def test_guesses_at_tokens_are_slowed_down_however_many_connections_make_them(
    gateway: Gateway, other: Visitor, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(token_checks, "PAUSE_S", SOON)
    for _ in range(3):
        page = Visitor(gateway.origin, source_address=("127.0.0.2", 0))
        for number in range(10):
            assert not page.ask("token", token=f"guess {number}")["accepted"]
        page.close()
    guesser = Visitor(gateway.origin, source_address=("127.0.0.2", 0))
    held = guesser.say("token", token="one more guess")
    refused = guesser.say("token", token="and another")
    reply = guesser.hear("reply")
    assert (reply["id"], reply["reason"][:23]) == (refused, "too many unknown tokens") and held != refused
    assert gateway.pages.counts["wrong token"] == 30
    assert other.ask("token")["accepted"]  # at another address
    guesser.close()


def test_the_rightful_person_behind_the_address_of_a_guesser_waits_a_moment_and_is_let_in(
    gateway: Gateway, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(token_checks, "PAUSE_S", 0.2)
    monkeypatch.setattr(token_checks, "UNKNOWN_AT_ONCE", 1.0)
    inside, guesser, late = (Visitor(gateway.origin, source_address=("127.0.0.2", 0)) for _ in range(3))
    for page in (inside, guesser, late):
        page.hear_what_is_played()
    inside.enter("cyan")
    for number in range(5):
        assert not guesser.ask("token", token=f"guess {number}")["accepted"]
    monkeypatch.setattr(token_checks, "PAUSE_S", 0.5)
    late.enter("referee")
    assert late.ask("action", action={"action": "stop"})["accepted"]
    assert inside.ask("parameters", request={"operation": "list"})["accepted"]  # has proven its token: no pause
    for page in (inside, guesser, late):
        page.close()


def test_all_seats_taken_by_one_address_leave_room_for_others_and_for_everyone_with_a_token(gateway: Gateway) -> None:
    crowd = [Visitor(gateway.origin, source_address=(f"127.0.0.{2 + number // 10}", 0)) for number in range(20)]
    eventually(lambda: len(gateway.pages) == 20)
    refused = Visitor(gateway.origin, source_address=("127.0.0.8", 0))
    assert "20 pages are open" in refused.hear("refusal")["reason"]
    for source in ("127.0.0.8", "127.0.0.2"):  # the address of the crowd, too
        coach = Visitor(gateway.origin, source_address=(source, 0))
        coach.token = TOKENS["cyan"]
        coach.say("token")
        assert coach.hear("welcome", role="cyan")["role"] == "cyan"
        coach.close()
    guesser = Visitor(gateway.origin, source_address=("127.0.0.2", 0))
    guesser.say("token", token="guess")
    assert "20 pages are open" in guesser.hear("refusal")["reason"]
    for page in (*crowd, refused, guesser):
        page.close()


def test_an_address_that_opens_pages_without_end_is_held_back_and_others_are_not(
    gateway_of: Callable[..., Gateway], host: FakeHost, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(socket_endpoint, "client_network", lambda address: address)
    monkeypatch.setattr(pages, "OPENED_AT_ONCE", 5.0)
    gateway = gateway_of()
    refused = 0
    for _ in range(20):
        client = RawClient(gateway.port, "127.0.0.2")
        refused += b"403" in client.upgrade(gateway.origin)
        client.close()
    assert refused == gateway.pages.counts["opened"] > 0
    other = Visitor(gateway.origin, source_address=("127.0.0.9", 0))
    assert other.hear("welcome")
    other.close()


def test_the_door_of_a_full_server_cannot_be_blocked_by_one_address(
    gateway: Gateway, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(door, "PATIENCE_S", SOON)
    crowd = [Visitor(gateway.origin, source_address=(f"127.0.0.{2 + number // 10}", 0)) for number in range(20)]
    eventually(lambda: len(gateway.pages) == 20)
    silent = [RawClient(gateway.port, "127.0.0.2") for _ in range(door.MOST_EACH + 2)]
    for client in silent:
        client.upgrade(gateway.origin)
    eventually(lambda: gateway.pages.counts["full"] == 2)
    coach = Visitor(gateway.origin, source_address=("127.0.0.8", 0))
    coach.token = TOKENS["magenta"]
    coach.say("token")
    coach.hear("welcome", role="magenta")
    coach.close()
    for client in silent:
        client.close()
    for page in crowd:
        page.close()


def test_a_deaf_page_that_goes_on_asking_is_dropped(
    gateway: Gateway, raw: RawClient, other: Visitor, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("coach_gateway.web.pages.STUCK_S", 0.5)
    ask = frame(b'{"id": 1, "deed": "token"}') + frame(b"{}")
    eventually(lambda: not raw.send(ask * 200) or raw.is_closed)
    assert len(gateway.pages) == 1


def test_a_page_without_a_host_sends_away_those_that_guess_send_too_much_or_do_not_read(
    tokens: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("coach_gateway.web.pages.STUCK_S", 0.3)
    waiting = Gateway(None, WebSettings(port=0), tokens)
    guesser = Visitor(waiting.origin)
    with pytest.raises(ConnectionClosed):
        for number in range(30):
            guesser.ask("token", token=f"guess {number}")
    flooder = Visitor(waiting.origin)
    with pytest.raises(ConnectionClosed):
        for _ in range(800):
            flooder.send("{")
        while True:
            flooder.hear("nothing")
    eventually(lambda: len(waiting.pages) == 0)
    deaf = RawClient(waiting.port, room=2048)
    deaf.upgrade(waiting.origin)
    eventually(lambda: len(waiting.pages) == 1)
    (page,) = waiting.pages
    waiting.call(lambda: [page.queue.put("x" * 100_000) for _ in range(50)])
    eventually(lambda: waiting.pages.counts["stuck"] == 1)
    deaf.close()
    for one in (guesser, flooder):
        one.close()
    waiting.close()
    assert "page: unknown token from this machine; further ones are counted" in waiting.logged
