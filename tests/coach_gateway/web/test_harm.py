"""No page can harm another or the match: forgers, garbage, floods, and pages that do not read."""

import http.client
import json
import socket
import time
from collections.abc import Callable

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from coach_gateway.web.pages import send_queue
from coach_gateway.web.serving import binding, uvicorn_server
from schemas.messages.world import ObstacleTruth
from schemas.topics import EVENT, WORLD
from support.fake_host import FakeHost
from support.messages import make_event, make_world
from support.page_gateway import SOON, TOKENS, Gateway
from support.process_story import wait_for
from support.raw_client import RawClient, deflated, frame
from support.visitor import Visitor

Visit = Callable[..., Visitor]
GatewayOf = Callable[..., Gateway]
PING, CONTINUED = 9, 0


def test_a_forged_token_is_unknown(visit: Visit, host: FakeHost) -> None:
    page = visit()
    for deed, content in (("token", {}), ("action", {"action": {"action": "stop"}})):
        reply = page.ask(deed, token="the-refere", **content)
        assert (reply["accepted"], reply["reason"][:13]) == (False, "unknown token")
    assert [question for question in host.asked if hasattr(question, "source")] == []


def test_a_page_comes_in_from_an_allowed_origin_and_from_no_other(host: FakeHost, gateway_of: GatewayOf) -> None:
    gateway = gateway_of(allow_origin=["https://cup.example.org"])
    for claimed in ("http://evil.example", ""):
        with pytest.raises(InvalidStatus) as refused:
            Visitor(gateway.origin, claims=claimed)
        assert refused.value.response.status_code == 403
    page = Visitor(gateway.origin, claims="https://cup.example.org")
    assert page.hear("welcome")["role"] == "spectator"
    page.close()


DEEP = 20_000
GARBAGE = [
    ("", "not JSON"),
    ("[]", "it is []; an object"),
    ('{"id": 4}', "deed is missing"),
    ('{"id": 4, "deed": "rule the world"}', "deed is 'rule the world'; one of action, order"),
    ('{"id": -1, "deed": "token"}', "id is -1; a whole number from 0"),
    ('{"id": 1e999, "deed": "token"}', "id"),
    ('{"id": ' + "9" * 5000 + ', "deed": "token"}', "id"),
    ('{"id": 4, "deed": "token", "more": 1}', "more is not known"),
    ('{"id": 4, "deed": "token", "token": {"$ne": ""}}', "token"),
    ('{"id": 4, "deed": "token", "token": "' + "x" * 60_000 + '"}', "token"),
    (
        '{"id": 4, "deed": "drive", "robot": "cyan1", "manual": {"drive": {"vx": NaN}}}',
        "drive.vx is nan; m/s from -20 to 20",
    ),
    ('{"id": 4, "deed": "drive", "robot": "**", "manual": {"drive": {}}}', "robot"),
    ('{"id": 4, "deed": "scene", "request": {"operation": "load", "scene": "../../../etc/passwd"}}', ""),
    ('{"id": 4, "deed": "action", "action": {"action": "explode"}}', "explode'; one of start, stop"),
    ('{"id": 4, "deed": "order", "side": "green", "order": {}}', "side is 'green'; one of cyan, magenta"),
    (b"\x00\xff", "only text"),
    ("[" * DEEP + "]" * DEEP, "not JSON"),
    ('{"id": 4, "deed": "action", "action": ' + "[" * DEEP + "]" * DEEP + "}", ""),
    (json.dumps({"id": 4, "deed": "token", **{f"field{number}": number for number in range(3000)}}), "is not known"),
]


def test_garbage_is_answered_in_one_line_and_the_page_goes_on(visit: Visit, host: FakeHost) -> None:
    page = visit()
    for rubbish, why in GARBAGE:
        page.send(rubbish)
        reply = page.hear("reply")
        assert not reply["accepted"] and why in reply["reason"], (rubbish[:60], reply)
        assert 0 < len(reply["reason"]) < 1000 and "\n" not in reply["reason"]
    assert page.ask("token")["accepted"]
    assert [question for question in host.asked if hasattr(question, "source")] == []


def test_a_page_that_sends_too_much_at_once_is_closed_without_a_word_in_the_log(
    gateway_of: GatewayOf, host: FakeHost, caplog: pytest.LogCaptureFixture
) -> None:
    gateway = gateway_of()
    for tick in range(1000):
        host.put(EVENT, make_event(tick, "x" * 1000))
    watching = Visitor(gateway.origin)
    while watching.hear("event")["event"]["tick"] < 999:
        pass
    for _ in range(5):  # while much waits to be sent to it
        page = Visitor(gateway.origin)
        page.send("x" * (uvicorn_server.MAX_MESSAGE_BYTES + 1))
        with pytest.raises(ConnectionClosed):
            while True:
                page.hear()
    watching.close()
    assert caplog.records == []


def test_refusals_are_named_once_counted_and_logged_at_the_end(host: FakeHost, gateway_of: GatewayOf) -> None:
    gateway = gateway_of()
    page = Visitor(gateway.origin)
    for rubbish in ("{", "[]", b"x"):
        page.send(rubbish)
        page.hear("reply")
    page.ask("token", token="unknown")
    with pytest.raises(InvalidStatus):
        Visitor(gateway.origin, claims="http://evil.example")
    page.close()
    gateway.close()
    assert gateway.logged == [
        "page: unreadable message from 127.0.0.1 ('{' is not JSON: EOF while parsing an object at line 1 column 1); "
        "further ones are counted",
        "page: unknown token from 127.0.0.1; further ones are counted",
        "page: page of a foreign origin from 127.0.0.1 (origin http://evil.example); further ones are counted",
        "page: refused 1 × page of a foreign origin, 1 × unknown token, 3 × unreadable message",
    ]


def test_a_broken_message_is_answered_under_its_number_where_it_has_one(visit: Visit) -> None:
    page = visit()
    page.send({"id": 77, "deed": "unknown"})
    assert page.hear("reply")["id"] == 77
    page.send('{"id": tru')
    assert page.hear("reply")["id"] is None


BROKEN: dict[str, Callable[[], bytes]] = {
    "a message beyond all measure": lambda: frame(b"x" * 1_000_000),
    "a message that inflates beyond all measure": lambda: frame(deflated(bytes(100_000_000)), compressed=True),
    "a text that is none": lambda: frame(b"\xff\xfe"),
    "a continuation of nothing": lambda: frame(b"", CONTINUED),
    "an unknown frame": lambda: frame(b"x", 3),
    "a frame without a mask": lambda: b"\x81\x00",
    "no frame": lambda: b"GET / HTTP/1.1\r\n\r\n",
}


@pytest.mark.parametrize("broken", BROKEN)
def test_what_breaks_the_protocol_ends_its_own_connection_alone(
    visit: Visit, gateway_of: GatewayOf, broken: str
) -> None:
    gateway, other = gateway_of(), visit()
    client = RawClient(gateway.port)
    assert b"permessage-deflate" in client.upgrade(gateway.origin, Sec_WebSocket_Extensions="permessage-deflate")
    client.send(BROKEN[broken]())
    wait_for(lambda: client.is_closed and len(gateway.pages) == 0)
    client.close()
    assert other.ask("token")["accepted"]


def test_a_flood_holds_up_no_command_of_another_page(visit: Visit) -> None:
    flooder, referee = visit(), visit("referee")
    for _ in range(20_000):
        flooder.send({"id": 1, "deed": "token"})
    assert referee.ask("action", action={"action": "stop"})["accepted"]
    flooder.socket.socket.close()  # it has read no reply: a closing handshake would wait for its end


def test_a_page_that_does_not_read_delays_no_other_and_is_dropped(
    host: FakeHost, gateway_of: GatewayOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(binding, "UNREAD_S", 0.5)
    gateway = gateway_of()
    reader, stuck = Visitor(gateway.origin), Visitor(gateway.origin, max_queue=1, compression=None)
    wait_for(lambda: len(gateway.pages) == 2)
    deadline, tick = time.monotonic() + SOON, 0
    while len(gateway.pages) == 2:
        assert time.monotonic() < deadline
        tick += 1
        host.play(tick)
        host.happen(tick, "x" * 20_000)
        reader.hear("frame", tick=tick)
    reader.close()
    stuck.socket.socket.close()


def test_a_deaf_page_that_goes_on_asking_is_dropped_before_it_fills_the_memory(
    host: FakeHost, gateway_of: GatewayOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(send_queue, "MOST", 500)
    monkeypatch.setattr(binding, "UNREAD_S", 2.0)
    gateway = gateway_of()
    deaf = RawClient(gateway.port, room=2048)
    deaf.upgrade(gateway.origin)
    while deaf.send(frame(b"{}") * 200):
        pass
    deaf.close()
    gateway.close()
    assert "page: page that does not read from 127.0.0.1; further ones are counted" in gateway.logged


def test_a_page_that_reads_slowly_skips_frames_and_sees_the_newest(
    host: FakeHost, gateway_of: GatewayOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(binding, "UNREAD_S", 600.0)  # however long the other page takes
    gateway = gateway_of()
    narrow = socket.socket()
    narrow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    narrow.connect(("127.0.0.1", gateway.port))
    quick, slow = (
        Visitor(gateway.origin),
        Visitor(gateway.origin, sock=narrow, max_queue=1, compression=None, ping_interval=None),
    )
    slow.hear("host", there=True)
    pillar = ObstacleTruth(x=1, y=2, heading=0, radius=0.5, height=1, shape="cylinder", size_x=1, size_y=1)
    full = make_world(0).replace(obstacles={f"pillar{number}": pillar for number in range(400)})
    for tick in range(1, 51):
        host.put(WORLD, full.replace(tick=tick))
        quick.hear("frame", tick=tick)
    ticks = [slow.hear("frame")["tick"]]
    while ticks[-1] < 50:
        ticks.append(slow.hear("frame")["tick"])
    assert len(ticks) < 15
    assert ticks == sorted(ticks)
    quick.close()
    slow.close()


def test_one_page_too_many_gets_the_reason_and_one_with_a_token_is_admitted(
    host: FakeHost, gateway_of: GatewayOf
) -> None:
    gateway = gateway_of(pages=1)
    first, second, coach = (Visitor(gateway.origin) for _ in range(3))
    coach.token = TOKENS["cyan"]
    coach.say("token")
    assert coach.hear("welcome", role="cyan")
    second.say("token", token="a guess")
    odd = Visitor(gateway.origin)
    odd.send(b"no text")
    for refused in (second, odd):
        assert "pages are open, which is the limit; try again later" in refused.hear("refusal")["reason"]
        with pytest.raises(ConnectionClosed):
            refused.hear()
    for page in (first, coach):
        page.close()
    wait_for(lambda: len(gateway.pages) == 0)
    third = Visitor(gateway.origin)
    assert third.hear()["kind"] == "welcome"
    third.close()


def test_a_server_with_very_many_connections_asks_to_come_again(
    gateway_of: GatewayOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(uvicorn_server, "_LOADING", 1)
    gateway = gateway_of(pages=1)
    crowd = [RawClient(gateway.port) for _ in range(2)]
    files = http.client.HTTPConnection("127.0.0.1", gateway.port, timeout=SOON)
    files.request("GET", "/page.css")
    assert files.getresponse().status == 503
    for one in (*crowd, files):
        one.close()
