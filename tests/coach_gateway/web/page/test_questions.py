"""A referee box gives a card without a robot: who sees the question which robot it is, and who may answer."""

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from runtime.bus.contract import Bus
from runtime.process.clock import WallClock
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName
from schemas.topics import ACTION
from support.page_gateway import SOON
from support.page_match import Match

SEEN = "document.getElementById('cyan-question').checkVisibility()"


class Box:
    """A referee box that commands a match, and has stopped it."""

    def __init__(self, match: Match) -> None:
        self.bus: Bus = match.medium.open_bus("friendly", WallClock())
        self.bus.declare_alive("refbox", "cyan")
        self.request(ActionName.STOP)

    def request(self, action: ActionName, side: Side | None = None) -> None:
        reply = self.bus.query(ACTION, RefereeAction(action=action, side=side, source="refbox"), SOON).result(SOON)
        assert reply.accepted, reply.reason


@pytest.fixture
def boxed(officiated: Callable[..., Match]) -> Iterator[tuple[Match, Box]]:
    match = officiated(still=True)
    box = Box(match)
    yield match, box
    box.bus.close()


@pytest.mark.parametrize("role", ["cyan", "referee"])
def test_a_press_names_the_robot_of_a_card_and_the_question_goes(
    boxed: tuple[Match, Box], visit: Callable[..., Any], role: str
) -> None:
    match, box = boxed
    tab = visit(match, role)
    assert not tab.ask(SEEN)
    box.request(ActionName.YELLOW_CARD, Side.CYAN)
    tab.until(SEEN)
    assert "Yellow card for Blues: which robot? cyan2 in " in tab.page.locator("#cyan-question p").inner_text()
    buttons = tab.page.locator("#cyan-question button")
    assert buttons.all_inner_texts() == ["cyan1", "cyan2"]
    buttons.first.click()
    tab.wait_for_log("Name cyan1 accepted")
    tab.until(f"!{SEEN}")
    assert match.state.robots["cyan1"].yellow == 1
    assert not match.state.questions


@pytest.mark.parametrize(("role", "place"), [("spectator", "in-force"), ("magenta", "cyan-question")])
def test_others_see_the_question_without_buttons(
    boxed: tuple[Match, Box], visit: Callable[..., Any], role: str, place: str
) -> None:
    match, box = boxed
    tab = visit(match, role)
    box.request(ActionName.YELLOW_CARD, Side.CYAN)
    tab.until(f"document.getElementById({place!r}).textContent.includes('Yellow card for Blues: which robot?')")
    assert tab.page.locator(f"#{place}").is_visible()
    assert not any(button.is_visible() for button in tab.page.locator("#pending button").all())
