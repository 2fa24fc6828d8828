"""The page's server over real sockets: what pages are told, and that no page can harm another or the match."""

import socket
import threading
import time
from collections.abc import Callable
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from coach_gateway.web.protocol import SAID
from schemas.bus.in_process import Medium
from schemas.coach import CoachMode, CoachOrder
from schemas.game import ActionName
from schemas.scene import shipped_scenes
from schemas.side import Side
from schemas.topics import EVENT, WORLD
from schemas.world import ObstacleTruth, RobotTruth

from .conftest import SOON, TOKENS, FakeHost, Gateway, Visitor, event, wait_for, world

Visit = Callable[..., Visitor]


def test_a_page_is_welcomed_and_then_told_how_things_stand_in_order(visit: Visit, host: FakeHost) -> None:
    watcher = visit()
    host.happen(1, "first")
    host.happen(2, "second")
    host.play(3)
    watcher.hear("event", event=event(2, "second").model_dump(mode="json"))
    watcher.hear("frame")
    late = visit()
    kinds = ["host", "refbox", "state", "health", "event", "event", "orders", "frame"]
    heard = [late.hear() for _ in kinds]
    assert sorted(message["kind"] for message in heard[:4]) == sorted(kinds[:4])
    assert [message["kind"] for message in heard[4:]] == kinds[4:]
    assert [message["event"]["text"] for message in heard if message["kind"] == "event"] == ["first", "second"]
    assert heard[-1]["world"]["ball"]["x"] == 3


def test_everything_that_is_said_is_as_the_protocol_has_it(visit: Visit, host: FakeHost) -> None:
    page = visit("referee")
    host.play(1)
    host.happen(1, "kick-off")
    host.stand(Side.CYAN, CoachOrder(sequence=1), cyan1=True, cyan2=False)
    page.say("scene", request={"deed": "reset"})
    waited_for = {"frame", "event", "state", "health", "orders", "reply"}
    while waited_for:
        waited_for -= {SAID.validate_json(page.socket.recv(SOON)).kind}


def test_a_frame_has_the_world_and_what_robots_believe(visit: Visit, host: FakeHost) -> None:
    watcher = visit()
    host.play(7)
    frame = watcher.hear("frame")
    assert (frame["tick"], frame["world"]["tick"]) == (7, 7)
    assert {name: belief["radio"]["role"] for name, belief in frame["beliefs"].items()} == {
        "cyan1": "striker",
        "magenta1": "striker",
    }


@pytest.mark.parametrize(
    ("role", "seen"),
    [("spectator", []), ("cyan", ["cyan1"]), ("magenta", ["magenta1"]), ("referee", ["cyan1", "magenta1"])],
)
def test_in_a_serious_match_a_team_s_beliefs_are_its_own(
    role: str, seen: list[str], host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway]
) -> None:
    host = host_of(rules="msl")
    page = Visitor(gateway_of().origin)
    page.hear("welcome", live=True)
    if role != "spectator":
        page.enter(role)
    host.play(1)
    host.play(2)
    assert sorted(page.hear("frame", tick=2)["beliefs"]) == seen
    page.close()


def test_orders_are_shown_to_their_side_and_to_the_referee_with_who_has_taken_them_in(
    visit: Visit, host: FakeHost
) -> None:
    pages = {role: visit(role) for role in ("spectator", "cyan", "magenta", "referee")}
    host.stand(Side.CYAN, CoachOrder(sequence=5, mode=CoachMode.HOLD), cyan1=True, cyan2=False)
    for role in ("cyan", "referee"):
        heard = pages[role].hear("orders")
        while heard["cyan"]["order"] is None:
            heard = pages[role].hear("orders")
        assert heard["cyan"]["order"]["mode"] == "hold"
        assert heard["cyan"]["acknowledged"] == {"cyan1": True, "cyan2": False}
    for role in ("spectator", "magenta"):
        host.happen(9, role)
        heard = pages[role].hear()
        while heard["kind"] != "event" or heard["event"]["text"] != role:
            assert heard["kind"] != "orders" or heard["cyan"] is None
            heard = pages[role].hear()


@pytest.mark.parametrize(
    ("deed", "content"),
    [
        ("action", {"action": {"action": "stop"}}),
        ("order", {"side": "cyan", "order": {"mode": "hold"}}),
        ("scene", {"request": {"deed": "reset"}}),
        ("parameters", {"request": {"deed": "reset"}}),
        ("parameters", {"request": {"deed": "list"}}),
        ("drive", {"robot": "cyan1", "hand": {}}),
        ("replay", {"request": {"deed": "pause"}}),
    ],
)
def test_a_spectator_cannot_command(deed: str, content: dict[str, Any], visit: Visit, host: FakeHost) -> None:
    reply = visit().ask(deed, **content)
    assert not reply["accepted"]
    assert "this page has none" in reply["reason"]
    assert [question for question in host.asked if hasattr(question, "source")] == []
    assert host.orders.receive() is None
    assert host.hands.receive() is None


def test_a_stop_of_the_referee_reaches_the_match_and_is_named_after_the_page(visit: Visit, host: FakeHost) -> None:
    """Reference 13, row 37."""
    page = visit("referee")
    assert page.ask("action", action={"action": "stop", "source": "somebody else"})["accepted"]
    refused = page.ask("action", action={"action": "corner", "side": "cyan"})
    assert (refused["accepted"], refused["reason"]) == (False, "play is running")
    asked = [question for question in host.asked if hasattr(question, "action")]
    assert [(question.action, question.source) for question in asked] == [
        (ActionName.STOP, "referee's page"),
        (ActionName.CORNER, "referee's page"),
    ]


def test_cyan_s_token_cannot_stop_magenta_s_robots(visit: Visit, host: FakeHost) -> None:
    """Reference 13, row 51."""
    page = visit("cyan")
    for deed, content in (
        ("action", {"action": {"action": "stop"}}),
        ("action", {"action": {"action": "park", "robot": "magenta1"}}),
        ("action", {"action": {"action": "repair", "robot": "magenta1"}}),
        ("action", {"action": {"action": "substitute", "robot": "magenta1"}}),
        ("action", {"action": {"action": "repair"}}),
        ("order", {"side": "magenta", "order": {"mode": "hold"}}),
        ("drive", {"robot": "magenta1", "hand": {}}),
        ("scene", {"request": {"deed": "remove", "remove": ["magenta1"]}}),
        ("parameters", {"request": {"deed": "set", "values": {"drive.max_speed": 0.1}}}),
    ):
        assert not page.ask(deed, **content)["accepted"], (deed, content)
    assert host.orders.receive() is None
    assert host.hands.receive() is None
    assert [question for question in host.asked if hasattr(question, "source")] == []


@pytest.mark.parametrize("side", ["cyan", "magenta"])
def test_a_coach_stops_drives_and_repairs_its_own_robots(side: str, visit: Visit, host: FakeHost) -> None:
    """Reference 14, defect 7; reference 13, row 43."""
    page = visit(side)
    given = page.ask("order", side=side, order={"mode": "hold", "max_speed": 1.5})
    received = host.orders.receive(SOON)
    assert received is not None and received.chunks == {"side": side}
    order: CoachOrder = received.message()
    assert given["accepted"]
    assert (order.mode, order.max_speed, order.sequence) == (CoachMode.HOLD, 1.5, given["answer"]["sequence"])
    page.say("drive", robot=f"{side}2", hand={"drive": {"vx": 1.0}})
    driven = host.hands.receive(SOON)
    assert driven is not None
    assert (driven.chunks, driven.message().drive.vx) == ({"robot": f"{side}2"}, 1.0)
    assert page.ask("action", action={"action": "repair", "robot": f"{side}2"})["accepted"]


def test_of_two_orders_the_later_one_has_the_larger_number(visit: Visit, host: FakeHost) -> None:
    page = visit("referee")
    numbers = [page.say("order", side="cyan", order={"tactic": tactic}) for tactic in ("one", "two", "three")]
    for number in numbers:
        assert page.hear("reply", id=number)["accepted"]
    orders = [wait_for(host.orders) for _ in numbers]
    assert [order.tactic for order in sorted(orders, key=lambda order: order.sequence)] == ["one", "two", "three"]
    assert len({order.sequence for order in orders}) == 3


def test_an_order_that_makes_no_sense_is_refused_with_the_reason(visit: Visit, host: FakeHost) -> None:
    page = visit("cyan")
    reply = page.ask("order", side="cyan", order={"mode": "hold", "robot_a": "magenta1"})
    assert (reply["accepted"], "no robot of cyan" in reply["reason"]) == (False, True)


def test_the_token_counts_in_each_message_and_not_who_the_page_was(visit: Visit) -> None:
    page = visit("referee")
    assert page.ask("action", action={"action": "stop"})["accepted"]
    assert not page.ask("action", token="", action={"action": "stop"})["accepted"]
    assert not page.ask("action", token=TOKENS["cyan"], action={"action": "stop"})["accepted"]


def test_a_forged_token_is_nobody_s(visit: Visit, host: FakeHost) -> None:
    page = visit()
    for forged in ("the-refere", "the-referee ", "THE-REFEREE", "x", "é" * 50):
        for deed, content in (("token", {}), ("action", {"action": {"action": "stop"}})):
            reply = page.ask(deed, token=forged, **content)
            assert (reply["accepted"], reply["reason"][:6]) == (False, "nobody")
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
    gateway = gateway_of(origins=("https://cup.example.org",))
    page = Visitor(gateway.origin, claims="https://cup.example.org")
    assert page.hear("welcome")["role"] == "spectator"
    page.close()


GARBAGE = [
    ("", "Invalid JSON"),
    ("{", "Invalid JSON"),
    ("[]", "should be an object"),
    ('{"id": 4}', "Unable to extract tag"),
    ('{"id": 4, "deed": "rule the world"}', "does not match any of the expected tags"),
    ('{"id": -1, "deed": "token"}', "greater than or equal to 0"),
    ('{"id": 4, "deed": "token", "more": 1}', "Extra inputs"),
    ('{"id": 4, "deed": "drive", "robot": "cyan1", "hand": {"drive": {"vx": NaN}}}', "finite|Invalid JSON"),
    ('{"id": 4, "deed": "action", "action": {"action": "explode"}}', "Input should be"),
    (b"\x00\xff", "only text"),
    ("[" * 5000, "Invalid JSON|recursion"),
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


def test_what_was_refused_is_counted_and_said_at_the_end(host: FakeHost, gateway_of: Callable[..., Gateway]) -> None:
    gateway = gateway_of()
    page = Visitor(gateway.origin)
    for rubbish in ("{", "[]", b"x"):
        page.send(rubbish)
        page.hear("reply")
    page.ask("token", token="nobody's")
    with pytest.raises(InvalidStatus):
        Visitor(gateway.origin, claims="http://evil.example")
    page.close()
    gateway.close()
    assert gateway.said == [
        "refused: 1 pages from elsewhere, 3 messages that could not be read, 1 uses of a token that is nobody's"
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


def test_a_page_that_does_not_read_keeps_nobody_waiting_and_is_dropped(
    visit: Visit, host: FakeHost, gateway_of: Callable[..., Gateway], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("coach_gateway.web.pages.STUCK_S", 0.5)
    gateway = gateway_of()
    reader = Visitor(gateway.origin)
    stuck = Visitor(gateway.origin, max_queue=1)
    deadline = time.monotonic() + SOON
    tick = 0
    while gateway.server.pages.counts["stuck"] == 0:
        assert time.monotonic() < deadline
        tick += 1
        host.play(tick)
        host.happen(tick, "x" * 20_000)
        reader.hear("frame")
    assert len(gateway.server.pages) == 1
    reader.close()
    stuck.socket.socket.close()


def test_a_page_that_reads_slowly_skips_frames_and_sees_the_newest(
    host: FakeHost, gateway_of: Callable[..., Gateway]
) -> None:
    gateway = gateway_of()
    narrow = socket.socket()
    narrow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    narrow.connect(("127.0.0.1", gateway.port))
    quick, slow = Visitor(gateway.origin), Visitor(gateway.origin, sock=narrow, max_queue=1)
    slow.hear("host", there=True)
    pillar = ObstacleTruth(x=1, y=2, heading=0, radius=0.5, height=1, shape="cylinder", size_x=1, size_y=1)
    full = world(0).model_copy(update={"obstacles": {f"pillar{number}": pillar for number in range(400)}})
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


def test_two_pages_see_the_same_match_and_each_gets_its_own_answers(visit: Visit, host: FakeHost) -> None:
    one, two = visit("referee"), visit("cyan")
    host.play(5)
    assert one.hear("frame")["tick"] == two.hear("frame")["tick"] == 5
    assert one.ask("action", action={"action": "stop"})["id"] == 2
    host.happen(6, "for both")
    for page in (one, two):
        heard = page.hear()
        while heard["kind"] != "event":
            assert heard["kind"] != "reply"
            heard = page.hear()


def test_one_page_more_than_there_is_room_for_is_told_so(host: FakeHost, gateway_of: Callable[..., Gateway]) -> None:
    gateway = gateway_of(pages=1)
    first, second = Visitor(gateway.origin), Visitor(gateway.origin)
    assert second.hear("refusal")["reason"] == "1 pages are open, and no more are let in; try again later"
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


def test_a_host_that_goes_is_seen_to_go_and_one_that_comes_is_welcomed_without_the_past_of_the_other(
    host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway]
) -> None:
    first = host_of()
    page = Visitor(gateway_of().origin)
    page.hear("host", there=True)
    page.enter("referee")
    first.play(100)
    first.happen(100, "of the first match")
    page.hear("event")
    first.die()
    page.hear("host", there=False)
    gone = page.ask("action", action={"action": "stop"})
    assert (gone["accepted"], gone["reason"]) == (False, "the host is gone; wait until it is back")
    second = host_of(rules="msl")
    second.happen(1, "of the second match")
    second.play(2)
    while page.hear("welcome")["setup"]["rules"] != "msl":
        pass
    assert page.hear("event")["event"]["text"] == "of the second match"
    assert page.ask("action", action={"action": "stop"})["accepted"]
    late = Visitor(f"http://{page.socket.remote_address[0]}:{page.socket.remote_address[1]}")
    while (heard := late.hear())["kind"] != "frame":
        assert heard["kind"] != "event" or heard["event"]["text"] == "of the second match"
    page.close()
    late.close()


def test_a_scene_with_other_robots_welcomes_all_pages_anew(visit: Visit, host: FakeHost) -> None:
    page = visit()
    standing = RobotTruth(x=0, y=0, z=0, heading=0, vx=0, vy=0, omega=0, holding=False)
    host.play(1)
    page.hear("frame", tick=1)
    host.put(WORLD, world(2).model_copy(update={"robots": {"cyan1": standing}}))
    assert page.hear("welcome")["setup"]["match"] == "friendly"
    host.put(WORLD, world(3).model_copy(update={"robots": {"cyan1": standing}, "episode": 2}))
    page.hear("welcome")


def test_a_page_that_asks_for_one_welcome_after_another_has_to_wait(visit: Visit) -> None:
    page = visit()
    replies = [page.ask("token") for _ in range(10)]
    assert [reply["accepted"] for reply in replies[:5]] == [True] * 5
    assert "wait a second" in next(reply["reason"] for reply in replies if not reply["accepted"])


def test_questions_that_wait_hold_up_neither_a_stop_nor_another_role(
    host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway]
) -> None:
    slow = threading.Event()
    host_of(slow=slow)
    gateway = gateway_of()
    coach, referee = Visitor(gateway.origin), Visitor(gateway.origin)
    for page, role in ((coach, "cyan"), (referee, "referee")):
        page.hear("welcome", live=True)
        while page.hear("host")["there"] is False:
            pass
        page.enter(role)
    for page in (coach, referee):
        for _ in range(8):
            page.say("parameters", request={"deed": "list"})
        refused = page.ask("parameters", request={"deed": "list"})
        assert refused["reason"] == "8 questions of this page still wait for their answers"
    assert referee.ask("action", action={"action": "stop"})["accepted"]
    assert not slow.is_set()
    slow.set()
    coach.close()
    referee.close()


def test_what_is_told_again_when_a_link_comes_back_is_neither_news_nor_another_host(
    visit: Visit, host: FakeHost, medium: Medium
) -> None:
    page = visit()
    readers = tuple(medium.subscriptions["friendly/game/event"])
    past = host.bus.subscribe(EVENT)
    for tick in range(3):
        host.happen(tick, f"event {tick}")
    page.hear("event", event=event(2, "event 2").model_dump(mode="json"))
    for received in iter(past.receive, None):
        for reader in readers:
            reader.bring(received.key, received)
    host.happen(3, "event 3")
    heard = page.hear()
    assert (heard["kind"], heard["event"]["text"]) == ("event", "event 3")


def test_a_page_that_comes_before_any_host_waits_and_is_welcomed_again(
    host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway]
) -> None:
    page = Visitor(gateway_of().origin)
    assert page.hear("welcome")["setup"] is None
    assert page.hear("host")["there"] is False
    host_of()
    assert page.hear("welcome")["setup"]["match"] == "friendly"
    page.close()


def test_a_welcome_names_the_scenes_that_can_be_loaded(host: FakeHost, gateway_of: Callable[..., Gateway]) -> None:
    page = Visitor(gateway_of().origin)
    scenes = page.hear("welcome")["scenes"]
    assert list(scenes) == shipped_scenes()
    assert all(scenes.values())
    page.close()


def test_a_server_that_is_started_again_has_the_same_tokens_and_all_events(
    host: FakeHost, gateway_of: Callable[..., Gateway]
) -> None:
    first = gateway_of()
    page = Visitor(first.origin)
    host.happen(1, "before")
    page.hear("event")
    first.close()
    with pytest.raises(ConnectionClosed):
        page.hear("nothing")
    again = Visitor(gateway_of(port=first.port).origin)
    again.hear("welcome", live=True)
    assert again.hear("event")["event"]["text"] == "before"
    again.enter("referee")
    assert again.ask("action", action={"action": "stop"})["accepted"]
    again.close()


def test_a_replay_tells_all_its_events_at_once_and_none_again(
    host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway]
) -> None:
    host = host_of(recorded=[event(1, "first"), event(900, "last")])
    page = Visitor(gateway_of().origin)
    assert page.hear("welcome", live=False)["beliefs"] == ["cyan", "magenta"]
    assert [page.hear("event")["event"]["text"] for _ in range(2)] == ["first", "last"]
    host.happen(1, "first")
    host.play(2)
    while (heard := page.hear())["kind"] != "frame":
        assert heard["kind"] != "event"
    assert page.hear("replay")["replay"]["end"] == 9.0
    assert not page.ask("replay", request={"deed": "pause"})["accepted"]
    page.enter("referee")
    sought = page.ask("replay", request={"deed": "seek", "to": "1.5"})
    assert (sought["accepted"], sought["answer"]["time"]) == (True, 1.5)
    changed = page.ask("order", side="cyan", order={})
    assert changed["reason"] == "this is a replay: what is recorded cannot be changed"
    page.close()


def test_a_referee_box_that_connects_is_told(visit: Visit, host: FakeHost, medium: Any) -> None:
    page = visit()
    host.bus.declare_alive("refbox", "cyan")
    page.hear("refbox", connected=True, team="cyan")
    host.bus.withdraw_alive("refbox", "cyan")
    page.hear("refbox", connected=False)


def test_what_the_server_says_first_has_no_token_where_they_stand_in_a_file(gateway_of: Callable[..., Gateway]) -> None:
    gateway = gateway_of()
    said = list(gateway.entrance.lines())
    assert said[0] == f"page: {gateway.origin}/"
    assert not any(token in line for line in said for token in TOKENS.values())
    own = list(gateway_of(tokens=None).entrance.lines())
    assert [line.partition(":")[0] for line in own] == ["page", "referee", "cyan", "magenta"]
    assert all("/#token=" in line for line in own[1:])
