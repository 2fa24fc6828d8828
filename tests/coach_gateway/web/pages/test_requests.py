"""Commands from pages, over real sockets: rights, and what reaches the match."""

import threading
from collections.abc import Callable

import pytest

from coach_gateway.web.pages.manual_control import ManualControl
from coach_gateway.web.pages.open_pages import Page
from coach_gateway.web.pages.protocol import PageDrive
from schemas.messages.coach import CoachMode, CoachOrder
from schemas.messages.manual import TIMEOUT_S, ManualDrive
from schemas.soccer.game import ActionName
from support.fake_host import FakeHost
from support.page_gateway import SOON, TOKENS, Gateway
from support.visitor import Visitor, wait_for

Visit = Callable[..., Visitor]


def test_a_spectator_cannot_command(visit: Visit, host: FakeHost) -> None:
    page = visit()
    for deed, content in (
        ("action", {"action": {"action": "stop"}}),
        ("order", {"side": "cyan", "order": {"mode": "hold"}}),
        ("drive", {"robot": "cyan1", "manual": {}}),
    ):
        reply = page.ask(deed, **content)
        assert not reply["accepted"] and "this page has none" in reply["reason"]
    assert [question for question in host.asked if hasattr(question, "source")] == []
    assert host.orders.receive() is None
    assert host.hands.receive() is None


def test_a_stop_of_the_referee_reaches_the_match_and_is_named_after_the_page(visit: Visit, host: FakeHost) -> None:
    page = visit("referee")
    assert page.ask("action", action={"action": "stop", "source": "x", "referee": "gateway_other"})["accepted"]
    refused = page.ask("action", action={"action": "corner", "side": "cyan"})
    assert (refused["accepted"], refused["reason"]) == (False, "play is running")
    invalid = page.ask("order", side="cyan", order={"mode": "hold", "robot_a": "magenta1"})
    assert not invalid["accepted"] and "no robot of cyan" in invalid["reason"]
    asked = [question for question in host.asked if hasattr(question, "action")]
    assert all(question.referee not in (None, "gateway_other") for question in asked)
    assert [(question.action, question.source) for question in asked] == [
        (ActionName.STOP, "referee's page"),
        (ActionName.CORNER, "referee's page"),
    ]


@pytest.mark.parametrize("side", ["cyan", "magenta"])
def test_a_coach_stops_drives_and_repairs_its_own_robots(side: str, visit: Visit, host: FakeHost) -> None:
    """In simatch, the stop of cyan's coach counts for both teams."""
    page = visit(side)
    given = page.ask("order", side=side, order={"mode": "hold", "max_speed": 1.5})
    received = host.orders.receive(SOON)
    assert received is not None and received.chunks == {"side": side}
    order: CoachOrder = received.message()
    assert given["accepted"]
    assert (order.mode, order.max_speed, order.sequence) == (CoachMode.HOLD, 1.5, given["answer"]["sequence"])
    page.say("drive", robot=f"{side}2", manual={"drive": {"vx": 1.0}})
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


def test_the_token_of_each_message_counts_and_not_the_role_of_the_page(visit: Visit) -> None:
    page = visit("referee")
    assert page.ask("action", action={"action": "stop"})["accepted"]
    assert not page.ask("action", token="", action={"action": "stop"})["accepted"]
    assert not page.ask("action", token=TOKENS["cyan"], action={"action": "stop"})["accepted"]


def test_questions_that_wait_hold_up_neither_a_stop_nor_another_role(
    host_of: Callable[..., FakeHost], gateway_of: Callable[..., Gateway]
) -> None:
    slow = threading.Event()
    host_of(slow=slow)
    gateway = gateway_of()
    coach, referee = Visitor(gateway.origin), Visitor(gateway.origin)
    for page, role in ((coach, "cyan"), (referee, "referee")):
        page.hear_what_is_played()
        page.enter(role)
    for page in (coach, referee):
        for _ in range(8):
            page.say("parameters", request={"operation": "list"})
        refused = page.ask("parameters", request={"operation": "list"})
        assert refused["reason"] == "8 requests of this page still wait for their replies"
    assert referee.ask("action", action={"action": "stop"})["accepted"]
    assert not slow.is_set()
    slow.set()
    coach.close()
    referee.close()


def test_a_robot_is_driven_from_one_page_at_a_time(visit: Visit, host: FakeHost) -> None:
    first, second = visit("cyan"), visit("referee")
    for vx in (1.0, 1.5):
        first.say("drive", robot="cyan1", manual={"drive": {"vx": vx}})
        assert wait_for(host.hands).drive.vx == vx
    first.say("drive", robot="cyan1", manual={"drive": {"vx": 2.0}})
    second.say("drive", robot="cyan2", manual={"drive": {"vx": -1.0}})
    assert sorted(wait_for(host.hands).drive.vx for _ in range(2)) == [-1.0, 2.0]  # each its own
    first.say("drive", robot="cyan1", manual={"release": True})
    assert wait_for(host.hands).release
    second.say("drive", robot="cyan1", manual={"drive": {"vx": -2.0}})
    assert wait_for(host.hands).drive.vx == -2.0


def test_a_second_hand_on_a_robot_is_refused_until_the_first_has_let_go() -> None:
    hands, first, second = ManualControl(), Page("one"), Page("other")
    drive = PageDrive(id=1, robot="cyan1", manual=ManualDrive())
    release = drive.replace(manual=ManualDrive(release=True))
    assert hands.refusal(first, drive, 10.0) is None
    assert "cyan1 is driven from another page" in (hands.refusal(second, drive, 10.1) or "")
    assert hands.refusal(second, release, 10.1) is not None  # nor does it take it out of the other's hand
    assert hands.refusal(first, drive, 10.4) is None
    assert hands.refusal(second, drive, 10.8) is not None
    assert hands.refusal(first, release, 10.8) is None
    assert hands.refusal(second, drive, 10.8) is None
    assert hands.refusal(first, drive, 10.8 + TIMEOUT_S) is None  # silent for so long, it has let go
