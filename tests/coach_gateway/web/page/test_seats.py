"""One layout for each seat: people see the commands that are theirs, and no others."""

import math

import pytest

from schemas.messages.coach import CoachMode
from schemas.side import Side
from schemas.soccer.game import Phase

DEAD = """[...document.querySelectorAll("button, select, input, textarea")]
    .filter((one) => one.checkVisibility() && one.disabled).map((one) => one.id || one.dataset.action)"""
OPENED = """[...document.querySelectorAll("[role=tab]")]
    .filter((tab) => tab.checkVisibility()).map((tab) => tab.dataset.tab)"""
BUTTONS = """[...document.querySelectorAll("#buttons [data-action]")]
    .filter((one) => one.checkVisibility()).map((one) => one.dataset.action + one.dataset.side)"""


@pytest.mark.parametrize("width", [1360, pytest.param(390, marks=pytest.mark.long)])
def test_a_spectator_sees_no_command_and_no_dead_button(resting, visit, width: int) -> None:
    match = resting
    tab = visit(match, width=width)
    beside = ["robots", "events"] if width < 1000 else []
    assert tab.ask(OPENED) == [*beside, "result", "host"]
    for panel in tab.ask(OPENED):
        tab.open(panel)
        assert tab.ask(DEAD) == []
    hidden = ("[data-action]", "#confirm", "#order-give", "#drive-take", "#scene-load", "#stop", "#seat")
    for command in (*hidden, "#layer-drawings"):
        assert not tab.page.locator(command).first.is_visible()
    tab.page.keyboard.press("Space")
    tab.drag(match.where("cyan1"), (0.0, 3.0))
    assert tab.page.locator("#log li:not(.of-others)").count() == 0
    assert match.state.phase is Phase.KICK_OFF


def test_a_coach_sees_the_commands_of_its_own_side_alone(match, visit) -> None:
    tab = visit(match, "cyan")
    assert tab.ask(OPENED) == ["result", "match", "coach", "drive", "settings", "host", "log"]
    orders = [f"{order}_ordercyan" for order in ("play", "hold", "park")]
    assert tab.ask(BUTTONS) == [*orders, "repair", "substitute", "enter"]
    options = tab.page.locator("#robot option")
    assert [options.nth(place).get_attribute("value") for place in range(options.count())] == ["", "cyan1", "cyan2"]
    tab.page.locator("[data-robot=magenta1] .who").click()
    assert tab.button("repair").is_disabled()
    tab.page.locator("#robot").select_option("cyan2")
    assert tab.button("repair").is_enabled()
    tab.page.keyboard.press("Space")
    match.until(lambda: Side.CYAN in match.host.simulation.orders)
    assert match.host.simulation.orders[Side.CYAN].mode is CoachMode.HOLD
    assert Side.MAGENTA not in match.host.simulation.orders
    tab.until("document.querySelector('[data-robot=cyan2] [data-is=order]').textContent === 'hold, acknowledged'")
    match.until(lambda: math.hypot(*(match.world["robots"]["cyan2"][axis] for axis in ("vx", "vy"))) < 0.02)


def test_the_referee_and_the_operator_have_a_page_each(match, visit) -> None:
    tab = visit(match, "referee")
    assert tab.ask(OPENED) == ["result", "match", "host", "log"]
    assert tab.page.locator("#role").inner_text() == "referee"
    tab.page.locator("#seat").click()
    assert tab.ask(OPENED) == ["result", "coach", "drive", "settings", "host", "log"]
    assert tab.page.locator("#scene-load").is_visible()
    assert tab.page.locator("#role").inner_text() == "operator"
    tab.page.reload()
    tab.until("window.touchline?.match.role === 'referee' && window.touchline.match.setup !== null")
    assert tab.page.locator("#role").inner_text() == "operator"  # of this tab, also when it is loaded again
    tab.page.locator("#seat").click()
    assert tab.button("kick_off", "cyan").is_visible()
