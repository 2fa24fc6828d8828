"""Messages to pages, over real sockets: their order, their receivers, and hosts and servers that come and go."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from coach_gateway.web.pages.protocol import ServerMessage
from coach_gateway.web.settings import WebSettings
from schemas.config.scene import shipped_scenes
from schemas.messages.coach import CoachMode, CoachOrder
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest, ReplayTopic
from schemas.messages.world import RobotTruth
from schemas.side import Side
from schemas.topics import EVENT, REPLAY_CONTROL, SETUP, WORLD
from schemas.wire.part_faults import decoded
from support.fake_host import FakeHost
from support.in_process_bus import SharedState
from support.messages import make_event, make_world
from support.page_gateway import SOON, TOKENS, Gateway
from support.visitor import Visitor

Visit = Callable[..., Visitor]


def test_a_page_is_welcomed_and_then_sent_the_state_in_order(visit: Visit, host: FakeHost) -> None:
    watcher = visit()
    host.happen(1, "first")
    host.happen(2, "second")
    host.play(3)
    waited_for = {"second", "state", "health", "frame"}
    while waited_for:
        heard = watcher.hear()
        waited_for.discard(heard["event"]["text"] if heard["kind"] == "event" else heard["kind"])
    late = visit()
    kinds = ["host", "refbox", "state", "health", "event", "event", "orders", "frame"]
    heard = [late.hear() for _ in kinds]
    assert sorted(message["kind"] for message in heard[:4]) == sorted(kinds[:4])
    assert [message["kind"] for message in heard[4:]] == kinds[4:]
    assert [message["event"]["text"] for message in heard if message["kind"] == "event"] == ["first", "second"]
    assert heard[-1]["world"]["ball"]["x"] == 3


def test_every_message_of_the_server_is_one_of_the_protocol(visit: Visit, host: FakeHost) -> None:
    page = visit("referee")
    host.play(1)
    host.happen(1, "kick-off")
    host.stand(Side.CYAN, CoachOrder(sequence=1), cyan1=True, cyan2=False)
    page.say("scene", request={"operation": "reset"})
    waited_for = {"frame", "event", "state", "health", "orders", "reply"}
    while waited_for:
        waited_for -= {decoded(ServerMessage, page.socket.recv(SOON)).__struct_config__.tag}


def test_a_spectator_s_frame_has_the_world_and_beliefs_and_no_drawings(visit: Visit, host: FakeHost) -> None:
    watcher = visit()
    host.play(7)
    frame = watcher.hear("frame")
    assert (frame["tick"], frame["world"]["tick"]) == (7, 7)
    assert {name: belief["radio"]["role"] for name, belief in frame["beliefs"].items()} == {
        "cyan1": "striker",
        "magenta1": "striker",
    }
    assert frame["debug"] == {}


@pytest.mark.parametrize(
    ("role", "seen"),
    [("spectator", []), ("cyan", ["cyan1"]), ("magenta", ["magenta1"]), ("referee", ["cyan1", "magenta1"])],
)
def test_in_a_serious_match_a_team_s_beliefs_and_drawings_are_its_own(
    role: str, seen: list[str], host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway]
) -> None:
    host = host_of(rules="msl")
    page = Visitor(gateway_of().origin)
    page.hear("welcome", live=True)
    if role != "spectator":
        page.enter(role)
    host.play(1)
    host.play(2)
    frame = page.hear("frame", tick=2)
    assert sorted(frame["beliefs"]) == sorted(frame["debug"]) == seen
    assert all(drawing["debug"]["values"] == {"tick": 2} for drawing in frame["debug"].values())
    page.close()


def test_a_drawing_is_shown_for_half_a_second_of_the_match(visit: Visit, host: FakeHost) -> None:
    page = visit("referee")
    host.play(1)
    host.put(WORLD, make_world(26, (26, 0.0)))
    assert sorted(page.hear("frame", tick=26)["debug"]) == ["cyan1", "magenta1"]
    host.put(WORLD, make_world(27, (27, 0.0)))
    assert page.hear("frame", tick=27)["debug"] == {}


def test_orders_are_shown_to_their_side_and_to_the_referee_with_their_acknowledgements(
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
    first.close()
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
    host.put(WORLD, make_world(2).replace(robots={"cyan1": standing}))
    assert page.hear("welcome")["setup"]["match"] == "friendly"
    host.put(WORLD, make_world(3).replace(robots={"cyan1": standing}, episode=2))
    page.hear("welcome")


def test_messages_repeated_when_a_link_comes_back_are_neither_news_nor_another_host(
    visit: Visit, host: FakeHost, medium: SharedState
) -> None:
    page = visit()
    readers = tuple(medium.subscriptions["friendly/game/event"])
    past = host.bus.subscribe(EVENT)
    for tick in range(3):
        host.happen(tick, f"event {tick}")
    page.hear("event", event=make_event(2, "event 2").plain())
    for received in iter(past.receive, None):
        for reader in readers:
            reader.deliver(received.key, received)
    host.happen(3, "event 3")
    heard = page.hear()
    assert (heard["kind"], heard["event"]["text"]) == ("event", "event 3")


def test_a_page_that_comes_before_any_host_waits_learns_its_role_and_is_welcomed_again(
    host_of: Callable[..., FakeHost], medium: SharedState, tokens: Path
) -> None:
    gateway = Gateway(None, WebSettings(port=0), tokens)
    page = Visitor(gateway.origin)
    welcome = page.hear("welcome")
    assert (welcome["match"], welcome["setup"], welcome["deeds"]) == ("friendly", None, [])
    assert page.hear("host")["there"] is False
    page.hear("alive")
    assert page.ask("token", token="nonsense")["reason"].startswith("unknown token")
    assert page.enter("referee")["setup"] is None
    refused = page.ask("action", action={"action": "stop"})
    assert (refused["accepted"], refused["reason"]) == (False, "no host plays this match yet")
    host_of()
    gateway.meet(medium)
    assert page.hear_what_is_played()["role"] == "referee"
    assert page.ask("action", action={"action": "stop"})["accepted"]
    page.close()
    gateway.close()


def test_a_welcome_names_the_scenes_that_can_be_loaded(host: FakeHost, gateway_of: Callable[..., Gateway]) -> None:
    page = Visitor(gateway_of().origin)
    scenes = page.hear("welcome")["scenes"]
    assert list(scenes) == shipped_scenes()
    assert all(scenes.values())
    page.close()


def test_a_replay_sends_all_its_events_at_once_and_none_again(
    host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway]
) -> None:
    host = host_of(recorded=[make_event(1, "first"), make_event(900, "last")])
    page = Visitor(gateway_of().origin)
    welcome = page.hear("welcome", live=False)
    assert welcome["beliefs"] == welcome["debug"] == ["cyan", "magenta"]
    assert [page.hear("event")["event"]["text"] for _ in range(2)] == ["first", "last"]
    host.happen(1, "first")
    host.play(2)
    while (heard := page.hear())["kind"] != "frame":
        assert heard["kind"] != "event"
    assert page.hear("replay")["replay"]["end"] == 9.0
    assert not page.ask("replay", request={"operation": "pause"})["accepted"]
    page.enter("referee")
    sought = page.ask("replay", request={"operation": "seek", "to": "1.5"})
    assert (sought["accepted"], sought["answer"]["time"]) == (True, 1.5)
    for deed, content in (("order", {"side": "cyan", "order": {}}), ("drive", {"robot": "cyan1", "manual": {}})):
        assert page.ask(deed, **content)["reason"] == "this is a replay: what is recorded cannot be changed"
    page.close()


def test_a_page_is_welcomed_with_the_topics_of_a_file_without_a_match_and_controls_its_replay_alone(
    medium: Any, gateway_of: Callable[..., Gateway]
) -> None:
    topics = [ReplayTopic(key="robot1/odom", encoding="json", messages=50, end=0.49)]
    replay: list[ReplayRequest] = []

    def answer(request: ReplayRequest) -> ReplayReply:
        replay.append(request)
        events = request.operation is ReplayOperation.EVENTS
        return ReplayReply(accepted=True, paused=True, end=0.49, topics=topics if events else [])

    host = FakeHost(medium, answers={REPLAY_CONTROL: answer, SETUP: lambda _: None}, in_threads=True)
    page = Visitor(gateway_of().origin)
    welcome = page.hear("welcome", live=False)
    assert welcome["setup"] is None
    assert [(one["key"], one["messages"], one["end"]) for one in welcome["topics"]] == [("robot1/odom", 50, 0.49)]
    page.enter("referee")
    assert page.ask("replay", request={"operation": "seek", "to": "0.2"})["accepted"]
    for _ in range(3):
        assert page.hear("replay")["replay"]["paused"]
    assert ReplayOperation.STEP not in [request.operation for request in replay], "there is no picture to wait for"
    for deed, content in (("action", {"action": {"action": "stop"}}), ("scene", {"request": {"operation": "reset"}})):
        reply = page.ask(deed, **content)
        assert (reply["accepted"], reply["reason"]) == (False, "this is a replay of a file without a match")
    page.close()
    host.close()


def test_pages_are_notified_of_a_referee_box_that_connects(visit: Visit, host: FakeHost, medium: Any) -> None:
    page = visit()
    host.bus.declare_alive("refbox", "cyan")
    page.hear("refbox", connected=True, team="cyan")
    host.bus.declare_alive("refbox", "magenta")
    page.hear("refbox", connected=True, team=None)
    host.bus.withdraw_alive("refbox", "magenta")
    page.hear("refbox", connected=True, team="cyan")
    host.bus.withdraw_alive("refbox", "cyan")
    page.hear("refbox", connected=False)


def test_the_first_lines_of_the_server_have_no_token_where_a_file_has_them(gateway_of: Callable[..., Gateway]) -> None:
    gateway = gateway_of()
    said = list(gateway.binding.lines())
    assert said[0] == f"page: {gateway.origin}/"
    assert not any(token in line for line in said for token in TOKENS.values())
    own = list(gateway_of(tokens_file=None).binding.lines())
    assert [line.partition(":")[0] for line in own] == ["page", "referee", "cyan", "magenta"]
    assert all("/#token=" in line for line in own[1:])
