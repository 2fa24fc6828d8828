"""What the match brings moves nothing under a hand: decisions, cards and goals have places reserved for them."""

from collections.abc import Callable
from typing import Any

import pytest

from schemas.messages.soccer.game import Score
from support.staged_match import StagedMatch

SIZES = [(1366, 768), (390, 844), (844, 390)]
"""A laptop, a phone, and the phone on its side."""

WATCH = """() => {
    window.shifts = [];
    new PerformanceObserver((list) => window.shifts.push(...list.getEntries().map(({ value, sources }) =>
        [value, ...sources.map(({ node }) => node?.outerHTML?.slice(0, 80) ?? node?.nodeName)])))
        .observe({ type: "layout-shift" });
}"""
BOXES = """() => {
    const boxes = {};
    for (const one of document.querySelectorAll("body *")) {
        if (!one.checkVisibility() || one.closest("#events li")) continue;
        const { x, y, width, height } = one.getBoundingClientRect();
        one.dataset.known ??= String(window.known = (window.known ?? 0) + 1);
        if (width > 1 && height > 1) boxes[one.dataset.known] = [x, y, one.outerHTML.slice(0, 90)];
    }
    return boxes;
}"""
"""Element → its place, of all that are seen but the lines of the list of events, which scrolls by itself."""


def moved(before: dict[str, Any], after: dict[str, Any]) -> list[str]:
    """The elements that are now more than 4 px from where they were."""
    return [
        f"{box[2]}: {before[name][:2]} -> {box[:2]}"
        for name, box in after.items()
        if name in before and max(abs(box[0] - before[name][0]), abs(box[1] - before[name][1])) > 4
    ]


@pytest.mark.parametrize(
    ("width", "height"), [SIZES[0], *(pytest.param(*one, marks=pytest.mark.long) for one in SIZES[1:])]
)
@pytest.mark.parametrize(
    "box", [pytest.param(False, marks=pytest.mark.long), True], ids=["no referee box", "a referee box"]
)
def test_no_element_moves_under_a_proposal_a_question_a_card_or_a_goal(
    staged: StagedMatch, visit: Callable[..., Any], width: int, height: int, box: bool
) -> None:
    """On the pages of a spectator, a coach and the referee, which are open at the same time."""
    staged.host.say(refbox=box)
    asks = (staged.ask_both_sides, "window.touchline.match.state.questions.length === 4")
    tabs = {role: visit(staged.origin, role, width, height) for role in ("spectator", "cyan", "referee")}
    pages = {role: tab.page for role, tab in tabs.items()}
    pages["referee"].wait_for_timeout(500)  # until the pages are laid out
    for page in pages.values():
        page.evaluate(WATCH)
    before = {role: page.evaluate(BOXES) for role, page in pages.items()}
    for happens, shown in (
        (staged.propose, "window.touchline.match.state.proposal !== null"),
        *([asks] if box else []),
        (staged.show_card, "document.getElementById('people').textContent.includes('magenta4')"),
        (staged.score, "document.getElementById('score').textContent === '10 : 0'"),
    ):
        happens()
        for tab in tabs.values():
            tab.until(shown)
        pages["referee"].wait_for_timeout(300)  # panels are filled five times a second
        for role, page in pages.items():
            assert moved(before[role], page.evaluate(BOXES)) == [], role
    for role, page in pages.items():
        assert page.evaluate("window.shifts") == [], role


def assert_in_its_place(tab: Any, button: str) -> None:
    slot, box = (tab.page.locator(one).bounding_box() for one in ("#pending", button))
    assert slot["y"] <= box["y"] and box["y"] + box["height"] <= slot["y"] + slot["height"]
    assert box["height"] >= 30 and box["width"] >= 40


def test_a_proposal_is_answered_in_its_place_on_every_screen(staged: StagedMatch, visit: Callable[..., Any]) -> None:
    tab = visit(staged.origin, "referee")
    staged.propose()
    for width, height in SIZES:
        tab.resize(width, height)
        for name in ("confirm", "overrule"):
            tab.until(f"!document.getElementById('{name}').disabled")
            assert_in_its_place(tab, f"#{name}")


def test_a_question_beside_another_and_a_proposal_is_answered_in_its_place_on_every_screen(
    staged: StagedMatch, visit: Callable[..., Any]
) -> None:
    tab = visit(staged.origin, "cyan")
    staged.propose()
    staged.ask_both_sides()
    last = '#cyan-question [data-names="cyan5"]'
    tab.page.locator(last).wait_for()
    for width, height in SIZES:
        tab.resize(width, height)
        assert_in_its_place(tab, last)
        assert tab.page.locator("#cyan-question p").bounding_box()["height"] >= 15
        assert not tab.page.locator("#magenta-question button").first.is_visible()
        if width < 1000:  # all robots are in view
            box, slot = (tab.page.locator(one).bounding_box() for one in (last, "#pending"))
            assert box["x"] + box["width"] <= slot["x"] + slot["width"]
    tab.page.locator(last).click()
    tab.wait_for_log("Name cyan5 accepted")
    assert_in_its_place(tab, last)


def test_a_page_keeps_the_result_of_its_match_when_host_and_server_have_ended(
    staged: StagedMatch, visit: Callable[..., Any]
) -> None:
    tab = visit(staged.origin)
    tab.loses_its_server = True
    staged.score()
    staged.end()
    tab.until("window.touchline.match.over")
    staged.host.close()
    over = "The match is over. This page keeps its result until it is closed."
    tab.until(f"document.getElementById('notice').textContent === {over!r}")
    staged.gateway.close()
    tab.until("!window.touchline.connection.up")
    tab.page.wait_for_timeout(500)
    assert tab.page.locator("#notice").inner_text() == over
    assert tab.page.locator("#result-score").inner_text() == "10 : 0"
    assert tab.page.locator("#cyan-scorers").inner_text() == "Lions (cyan 3) 0:00.0"
    assert tab.page.locator("#result-title").inner_text() == "Final result"
    assert tab.page.locator("#score").inner_text() == "10 : 0"


@pytest.mark.parametrize("then", [["miss_penalty"], ["reset", "score"]])
def test_the_result_has_the_scorers_of_the_goals_that_count(
    then: list[str], staged: StagedMatch, visit: Callable[..., Any]
) -> None:
    """The events of a shoot-out have the score of the penalties, and those before a reset are of another game."""
    tab = visit(staged.origin)
    for what in ["score", *then]:
        getattr(staged, what)()
    tab.until(f"window.touchline.match.events.length === {1 + len(then)}")
    tab.page.wait_for_timeout(100)
    assert tab.page.locator("#cyan-scorers").inner_text() == "Lions (cyan 3) 0:00.0"


def test_goals_and_the_score_are_announced_and_the_score_at_the_beginning_is_not(
    staged: StagedMatch, visit: Callable[..., Any]
) -> None:
    tab = visit(staged.origin)
    announcer = tab.page.locator("#announcer")
    assert announcer.get_attribute("aria-live") == "polite"
    assert announcer.inner_text() == ""
    staged.score()
    tab.until("document.getElementById('announcer').textContent === 'Goal for Lions. Lions 10, NuBot 0.'")
    staged.host.say(score=Score(cyan=9, magenta=0))
    tab.until("document.getElementById('announcer').textContent === 'The score is corrected. Lions 9, NuBot 0.'")


def test_a_press_meant_for_one_proposal_does_not_answer_the_next(
    staged: StagedMatch, visit: Callable[..., Any]
) -> None:
    tab = visit(staged.origin, "referee")
    staged.propose()
    tab.until("!document.getElementById('confirm').disabled")
    replaced = """() => {
        const { match } = window.touchline;
        match.receive({ kind: "state", state: { ...match.state, proposal: "penalty for magenta" } });
        return document.getElementById("confirm").disabled;
    }"""
    assert tab.page.evaluate(replaced) is True
    tab.until("!document.getElementById('confirm').disabled")


def test_the_whole_field_and_stop_are_in_view_on_every_screen(staged: StagedMatch, visit: Callable[..., Any]) -> None:
    """Two of the sizes are laptops at a zoom of 200 %."""
    tab = visit(staged.origin, "referee")
    for width, height in (*SIZES, (683, 384), (640, 360)):
        tab.resize(width, height)
        for scrolled in (0, 10_000):
            tab.page.evaluate(f"window.scrollTo(0, {scrolled})")
            stop = tab.page.locator("#stop").bounding_box()
            assert stop is not None and stop["y"] >= 0 and stop["y"] + stop["height"] <= height
        tab.page.evaluate("window.scrollTo(0, 0)")
        field = tab.page.locator("#moving").bounding_box()
        assert field is not None and field["x"] >= 0 and field["x"] + field["width"] <= width
        assert field["y"] >= 0 and field["y"] + field["height"] <= height
        assert field["height"] >= min(0.3 * height, 0.6 * width)
