"""What a press does: a double click counts once, what cannot be undone is pressed twice or held, and space is text."""

import pytest

from schemas.soccer.game import Phase

LATER_MS = 500
"""Longer than two clicks of a double click are apart."""


def test_a_double_click_scores_one_goal(match, visit) -> None:
    tab = visit(match, "referee")
    tab.button("goal", "cyan").dblclick()
    tab.wait_for_log("Goal +, cyan accepted")
    tab.page.wait_for_timeout(LATER_MS)
    assert match.state.score.cyan == 1
    tab.button("goal", "cyan").click()
    match.until(lambda: match.state.score.cyan == 2)
    tab.button("cancel_goal", "cyan").click()
    match.until(lambda: match.state.score.cyan == 1)


def test_a_held_key_presses_a_button_once(match, visit) -> None:
    tab = visit(match, "referee")
    tab.button("goal", "magenta").focus()
    for _ in range(5):
        tab.page.keyboard.down("Enter")  # the first is a press, further ones are its repetitions
        tab.page.wait_for_timeout(150)
    tab.page.keyboard.up("Enter")
    tab.wait_for_log("Goal +, magenta accepted")
    assert match.state.score.magenta == 1


def test_the_end_of_a_half_is_pressed_twice_and_not_by_a_double_click(match, visit) -> None:
    tab = visit(match, "referee")
    button = tab.button("end_half")
    button.dblclick()
    assert button.inner_text() == "Press again"
    tab.page.wait_for_timeout(LATER_MS)
    assert tab.page.locator("#log li:not(.of-others)").count() == 0
    button.click()
    tab.wait_for_log("End half")
    assert button.inner_text() == "End half"  # a third press would have to be made sure of again


@pytest.mark.parametrize("way", [pytest.param("mouse", marks=pytest.mark.long), "finger", "key"])
def test_the_end_of_a_match_is_held_for_a_second(match, visit, way: str) -> None:
    tab = visit(match, "referee", has_touch=way == "finger")
    button = tab.button("end_game")
    button.scroll_into_view_if_needed()
    box = button.bounding_box()
    assert box is not None
    place = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def press() -> None:
        if way == "mouse":
            tab.page.mouse.move(*place)
            tab.page.mouse.down()
        elif way == "finger":
            tab.touch("Start", place)
        else:
            button.focus()
            tab.page.keyboard.down("Enter")

    def release() -> None:
        if way == "mouse":
            tab.page.mouse.up()
        elif way == "finger":
            tab.touch("End")
        else:
            tab.page.keyboard.up("Enter")

    tab.page.clock.install()
    tab.page.clock.pause_at(tab.ask("Date.now()") / 1000 + 1.0)
    for _ in range(2):
        press()
        assert button.inner_text() == "Keep holding"
        tab.page.clock.run_for(900)
        release()
        assert button.inner_text() == "End match"
        tab.page.clock.run_for(900)
    assert tab.page.locator("#log li:not(.of-others)").count() == 0
    assert match.state.phase is not Phase.FULL_TIME
    press()
    tab.page.clock.run_for(1100)
    match.until(lambda: match.host.simulation.over)
    release()


def test_a_space_in_a_text_is_typed_and_stops_nothing(match, visit) -> None:
    tab = visit(match, "referee")
    tab.open("coach")
    for field, words in (("#order-tactic", "wide left"), ("#parameter-filter", "max speed")):
        if field == "#parameter-filter":
            tab.open("settings")
        tab.page.locator(field).focus()
        tab.page.keyboard.type(words)
        assert tab.page.locator(field).input_value() == words
    assert tab.page.locator("#log li:not(.of-others)").count() == 0
