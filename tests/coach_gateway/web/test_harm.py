"""No page can harm another or the match: strangers, forgers, garbage, floods, and pages that do not read."""

import socket
import time
from collections.abc import Callable

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from schemas.messages.world import ObstacleTruth
from schemas.topics import WORLD
from support.fake_host import FakeHost
from support.messages import make_world
from support.page_gateway import SOON, Gateway
from support.visitor import Visitor

Visit = Callable[..., Visitor]


def test_a_forged_token_is_unknown(visit: Visit, host: FakeHost) -> None:
    page = visit()
    for forged in ("the-refere", "the-referee ", "THE-REFEREE", "x", "é" * 50):
        for deed, content in (("token", {}), ("action", {"action": {"action": "stop"}})):
            reply = page.ask(deed, token=forged, **content)
            assert (reply["accepted"], reply["reason"][:13]) == (False, "unknown token")
    assert [question for question in host.asked if hasattr(question, "source")] == []


def test_a_page_that_tries_one_token_after_another_is_sent_away(visit: Visit) -> None:
    page = visit()
    with pytest.raises(ConnectionClosed) as closed:
        for number in range(50):
            page.ask("token", token=f"guess {number}")
    assert closed.value.rcvd is not None and closed.value.rcvd.code == 1008


@pytest.mark.parametrize("claims", ["http://evil.example", "https://127.0.0.1", "null", "http://127.0.0.1:1", ""])
def test_a_page_from_elsewhere_does_not_come_in(
    claims: str, host: FakeHost, gateway_of: Callable[..., Gateway]
) -> None:
    with pytest.raises(InvalidStatus) as refused:
        Visitor(gateway_of().origin, claims=claims)
    assert refused.value.response.status_code == 403


def test_a_page_from_an_allowed_origin_comes_in(host: FakeHost, gateway_of: Callable[..., Gateway]) -> None:
    gateway = gateway_of(allow_origin=["https://cup.example.org"])
    page = Visitor(gateway.origin, claims="https://cup.example.org")
    assert page.hear("welcome")["role"] == "spectator"
    page.close()


GARBAGE = [
    ("", "not JSON"),
    ("{", "not JSON"),
    ("[]", "it is []; an object"),
    ('{"id": 4}', "deed is missing"),
    ('{"id": 4, "deed": "rule the world"}', "deed is 'rule the world'; one of action, order"),
    ('{"id": -1, "deed": "token"}', "id is -1; at least 0"),
    ('{"id": 4, "deed": "token", "more": 1}', "more is not known"),
    (
        '{"id": 4, "deed": "drive", "robot": "cyan1", "manual": {"drive": {"vx": NaN}}}',
        "drive.vx is nan; m/s from -20 to 20",
    ),
    ('{"id": 4, "deed": "action", "action": {"action": "explode"}}', "explode'; one of start, stop"),
    (b"\x00\xff", "only text"),
    ("[" * 5000, "not JSON"),
    ("x" * 100_000, "too long"),
]


def test_garbage_is_answered_and_the_page_goes_on(visit: Visit) -> None:
    page = visit()
    for rubbish, why in GARBAGE:
        page.send(rubbish)
        reply = page.hear("reply")
        assert not reply["accepted"]
        assert any(part in reply["reason"] for part in why.split("|")), (rubbish[:60], reply)
    assert page.ask("token")["accepted"]


def test_refusals_are_named_once_counted_and_logged_at_the_end(
    host: FakeHost, gateway_of: Callable[..., Gateway]
) -> None:
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
    assert gateway.logged[:-1] == [
        "page: unreadable message from this machine ('{' is not JSON: EOF while parsing an object at line 1 column 1); "
        "further ones are counted",
        "page: unknown token from this machine; further ones are counted",
        "page: page refused for its origin from this machine (origin http://evil.example); further ones are counted",
    ]
    assert gateway.logged[-1:] == [
        "refused or dropped: 1 page refused for its origin, 3 unreadable messages, 1 unknown token"
    ]


def test_a_broken_message_is_answered_under_its_number_where_it_has_one(visit: Visit) -> None:
    page = visit()
    page.send({"id": 77, "deed": "unknown"})
    assert page.hear("reply")["id"] == 77
    page.send('{"id": tru')
    assert page.hear("reply")["id"] is None


def test_a_message_beyond_all_measure_ends_its_own_page_alone(visit: Visit) -> None:
    rude, other = visit(), visit()
    rude.send("x" * 1_000_000)
    with pytest.raises(ConnectionClosed):
        while True:
            rude.hear("nothing")
    assert other.ask("token")["accepted"]


def test_a_flood_is_held_back_and_its_page_sent_away_while_others_command(visit: Visit, host: FakeHost) -> None:
    flooder, referee = visit(), visit("referee")
    with pytest.raises(ConnectionClosed) as closed:
        for _ in range(20_000):
            flooder.send({"id": 1, "deed": "token"})
        while True:
            flooder.hear("nothing")
    assert closed.value.rcvd is None or closed.value.rcvd.code == 1008
    assert referee.ask("action", action={"action": "stop"})["accepted"]


def test_a_page_that_does_not_read_delays_no_other_and_is_dropped(
    visit: Visit, host: FakeHost, gateway_of: Callable[..., Gateway], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("coach_gateway.web.pages.STUCK_S", 0.5)
    gateway = gateway_of()
    reader = Visitor(gateway.origin)
    stuck = Visitor(gateway.origin, max_queue=1, compression=None)
    deadline = time.monotonic() + SOON
    tick = 0
    while gateway.server.pages.counts["stuck"] == 0:
        assert time.monotonic() < deadline
        tick += 1
        host.play(tick)
        host.happen(tick, "x" * 20_000)
        reader.hear("frame", tick=tick)
    while len(gateway.server.pages) == 2:  # it is counted first, and then taken leave of
        assert time.monotonic() < deadline
        time.sleep(0.01)
    host.play(tick + 1)
    reader.hear("frame", tick=tick + 1)
    reader.close()
    stuck.socket.socket.close()


def test_a_page_that_reads_slowly_skips_frames_and_sees_the_newest(
    host: FakeHost, gateway_of: Callable[..., Gateway], monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in ("pages", "listener"):  # however long the other page takes to see all frames, this one is let be
        monkeypatch.setattr(f"coach_gateway.web.{module}.STUCK_S", 600.0)
    gateway = gateway_of()
    narrow = socket.socket()
    narrow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    narrow.connect(("127.0.0.1", gateway.port))
    quick, slow = Visitor(gateway.origin), Visitor(gateway.origin, sock=narrow, max_queue=1, compression=None)
    slow.hear("host", there=True)
    pillar = ObstacleTruth(x=1, y=2, heading=0, radius=0.5, height=1, shape="cylinder", size_x=1, size_y=1)
    full = make_world(0).model_copy(update={"obstacles": {f"pillar{number}": pillar for number in range(400)}})
    for tick in range(1, 101):
        host.put(WORLD, full.model_copy(update={"tick": tick}))
        quick.hear("frame", tick=tick)
    ticks = [slow.hear("frame")["tick"]]
    while ticks[-1] < 100:
        ticks.append(slow.hear("frame")["tick"])
    assert len(ticks) < 30
    assert ticks == sorted(ticks)
    quick.close()
    slow.close()


def test_one_page_too_many_gets_the_reason(host: FakeHost, gateway_of: Callable[..., Gateway]) -> None:
    gateway = gateway_of(pages=1)
    first, second = Visitor(gateway.origin), Visitor(gateway.origin)
    assert second.hear("refusal")["reason"] == "1 pages are open, which is the limit; try again later"
    with pytest.raises(ConnectionClosed):
        second.hear()
    first.close()
    deadline = time.monotonic() + SOON
    while len(gateway.server.pages):
        assert time.monotonic() < deadline
        time.sleep(0.01)
    third = Visitor(gateway.origin)
    assert third.hear()["kind"] == "welcome"
    third.close()


def test_a_page_that_asks_for_one_welcome_after_another_has_to_wait(visit: Visit) -> None:
    page = visit()
    asked = [page.say("token") for _ in range(10)]
    replies = [page.hear("reply", id=number) for number in asked]
    assert [reply["accepted"] for reply in replies[:5]] == [True] * 5
    assert "wait a second" in next(reply["reason"] for reply in replies if not reply["accepted"])
