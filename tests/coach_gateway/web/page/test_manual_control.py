"""Dragging and driving on the page by fingers and keys, and what may not be moved."""

import math

import pytest

from runtime.process.clock import WallClock
from schemas.soccer.game import Phase
from schemas.topics import MANUAL

PHONE = {"width": 390, "height": 844, "has_touch": True, "is_mobile": True}


def stop(tab) -> None:
    tab.page.locator("#stop").click()
    tab.wait_for_log("Stop accepted")


def drop(match, tab) -> tuple[float, float]:
    """Drop the ball; returns where it lies."""
    tab.button("drop_ball").click()
    match.until(lambda: match.state.phase is Phase.DROP_BALL and match.state.spot is not None)
    spot = match.state.spot
    tab.until_seen("ball", spot.x, spot.y)
    return spot.x, spot.y


def take(match, tab, robot: str):
    """Take over a robot; returns a function for the drives that are sent from then on."""
    hands = match.hear(MANUAL)
    tab.open("drive")
    tab.page.locator("#drive-robot").select_option(robot)
    tab.page.locator("#drive-take").click()
    match.until(lambda: match.said(f"{robot} is under manual control"))
    return hands


def test_a_finger_drags_a_robot_and_a_second_finger_has_no_part_in_it(resting, visit) -> None:
    match = resting
    tab = visit(match, "referee", **PHONE)
    stop(tab)
    tab.until_seen("robots.cyan1", *match.where("cyan1"))
    tab.wait_until_laid_out()
    begin, end, elsewhere = tab.at(*match.where("cyan1")), tab.at(-6.0, 5.0), tab.at(8.0, -4.0)
    tab.touch("Start", begin)
    here = tuple((a + b) / 2 for a, b in zip(begin, end, strict=True))
    tab.touch("Move", here)
    tab.touch("Start", here, elsewhere)
    tab.touch("Move", here, (elsewhere[0] + 5, elsewhere[1]))
    tab.touch("End", elsewhere, first=1)  # the second finger leaves: that places no body
    tab.touch("Move", end)
    tab.touch("End")
    tab.until("document.querySelector('#log li')?.textContent.includes('cyan1 to (')")
    match.until(lambda: math.dist(match.where("cyan1"), (-6.0, 5.0)) < 1.0)
    assert tab.page.locator("#log li:not(.of-others)").count() == 2


def test_a_finger_beside_all_bodies_scrolls_the_page(resting, visit) -> None:
    match = resting
    tab = visit(match, "referee", width=390, height=500, has_touch=True, is_mobile=True)
    stop(tab)
    tab.wait_until_laid_out()
    x, y = tab.at(0.0, 6.9)
    tab.touch("Start", (x, y + 20))
    for step in range(1, 8):
        tab.touch("Move", (x, y + 20 - 30 * step))
    tab.touch("End")
    tab.until("window.scrollY > 50")
    assert tab.page.locator("#log li:not(.of-others)").count() == 1


def test_a_finger_on_the_buttons_drives_for_as_long_as_it_lies_there(match, visit) -> None:
    tab = visit(match, "cyan", **PHONE)
    hands = take(match, tab, "cyan2")
    pad = tab.page.locator("#pad [data-code=KeyW]")
    pad.scroll_into_view_if_needed()
    box = pad.bounding_box()
    assert box is not None
    tab.touch("Start", (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2))
    match.until(lambda: any(hand.drive.vx == pytest.approx(1.5) for hand in hands()))
    tab.touch("End")
    match.until(lambda: any(hand.drive.vx == 0.0 for hand in hands()))
    tab.page.locator("#dribble").tap()
    match.until(lambda: any(hand.dribble for hand in hands()))
    tab.page.locator("#kick-lob").tap()
    match.until(lambda: any(hand.kick is not None and hand.kick.mode == "lob" for hand in hands()))
    tab.page.locator("#drive-take").tap()
    match.until(lambda: match.said("cyan2 is controlled by its brain again"))


def test_a_key_that_is_let_go_of_beside_another_does_not_drive_on(match, visit) -> None:
    tab = visit(match, "cyan")
    hands = take(match, tab, "cyan2")
    tab.page.keyboard.down("w")
    match.until(lambda: any(hand.drive.vx > 0.0 for hand in hands()))
    tab.page.keyboard.down("Control")
    tab.page.keyboard.up("w")
    tab.page.keyboard.up("Control")
    match.until(lambda: any(hand.drive.vx == 0.0 for hand in hands()))
    tab.page.wait_for_timeout(150)
    assert all(hand.drive.vx == 0.0 for hand in hands())


def test_a_page_that_is_no_longer_seen_gives_the_robot_back(match, visit) -> None:
    """A hidden page's clock ticks once a second: the robot would be taken and given back each time."""
    tab = visit(match, "cyan")
    take(match, tab, "cyan2")
    tab.page.evaluate(
        """() => {
            Object.defineProperty(document, "hidden", { get: () => true, configurable: true });
            document.dispatchEvent(new Event("visibilitychange"));
        }"""
    )
    match.until(lambda: match.said("cyan2 is controlled by its brain again"))
    assert tab.page.locator("#drive-take").inner_text() == "Take over"


def test_what_a_coach_drags_stays_where_it_is(resting, visit) -> None:
    match = resting
    referee, tab = visit(match, "referee"), visit(match, "cyan")
    for body, (x, y) in (("ball", drop(match, referee)), ("robots.cyan1", match.where("cyan1"))):
        tab.until_seen(body, x, y)
        tab.drag((x, y), (3.0, 3.0))
        tab.wait_for_log("refused: only the referee places bodies")
        tab.until_seen(body, x, y)
    assert tab.ask("window.touchline.selection.dragged") is None


def test_while_a_referee_box_commands_only_stop_is_left_and_the_page_shows_the_reason(resting, visit) -> None:
    match = resting
    tab, spectator = visit(match, "referee"), visit(match)
    ball = drop(match, tab)
    box = match.medium.open_bus("friendly", WallClock())
    box.declare_alive("refbox", "cyan")
    for one in (tab, spectator):
        one.until("document.getElementById('notice').textContent.includes('A referee box commands the match of cyan')")
        assert one.page.locator("#notice").is_visible()
    tab.drag(ball, (3.0, 2.0))
    tab.wait_for_log("refused: the referee box commands the match")
    assert "the referee box commands the match" in (tab.button("corner", "cyan").get_attribute("title") or "")
    assert tab.button("corner", "cyan").is_disabled()
    stop(tab)
    box.declare_alive("refbox", "magenta")
    tab.until("document.getElementById('notice').textContent.includes('A referee box commands the match; ')")
    box.close()
    tab.until("document.getElementById('notice').hidden && !document.querySelector('[data-action=corner]').disabled")


def test_what_is_in_the_hand_when_the_game_goes_on_is_not_set_down(resting, visit) -> None:
    match = resting
    tab = visit(match, "referee")
    stop(tab)
    tab.page.mouse.move(*tab.at(*match.where("cyan1")))
    tab.page.mouse.down()
    tab.page.mouse.move(*tab.at(-6.0, 5.0))
    tab.until("window.touchline.selection.dragged !== null")
    other = visit(match, "referee")
    drop(match, other)
    other.button("start").click()
    tab.until("window.touchline.match.state?.running")
    tab.page.mouse.up()
    tab.wait_for_log("Move cyan1 refused: the game is running")
