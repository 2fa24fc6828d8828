"""The page of a match of eleven a side: all robots are there, in order, and nothing covers or cuts anything."""

from collections.abc import Iterator

import pytest

from schemas.side import Side
from support.page_match import Match

SIDES = {side.value: {"brain": "support.page_match:Announcing", "size": 11} for side in Side}
NAMES = [f"{side.value}{number}" for side in Side for number in range(1, 12)]
CUT = """[...document.querySelectorAll(".panel .who, .panel .who b, .panel .who .mark, .panels, .pitch-section")]
    .filter((one) => one.checkVisibility() && one.scrollWidth > one.clientWidth + 1 && one.clientWidth > 0)
    .map((one) => one.className + one.textContent.slice(0, 20))"""
ROWS = """(side) => new Set([...document.querySelectorAll(`#${side}-robots > li`)].map((one) => one.offsetTop)).size"""


@pytest.fixture(scope="module")
def crowd() -> Iterator[Match]:
    """Before a kick-off; the robots stand in their formations."""
    match = Match(teams=SIDES, rules="eleven", referee={"mode": "manual"})
    match.signal_kick_off()
    yield match
    match.close()


def test_every_robot_has_a_panel_in_the_order_of_the_numbers_and_nothing_is_cut(crowd, visit) -> None:
    tab = visit(crowd, "referee")
    tab.until("document.querySelectorAll('.panel').length === 22")
    panels = "[...document.querySelectorAll('.panel')].map((one) => one.dataset.robot)"
    assert tab.ask(panels) == NAMES
    for width, height, rows in ((1440, 900, 2), (1360, 900, 2), (1100, 800, 3), (390, 844, 11)):
        tab.resize(width, height)
        if width < 1000:
            tab.open("robots")
        tab.until("[...document.querySelectorAll('.badge')].every((one) => !one.checkVisibility())")
        assert tab.ask("document.documentElement.scrollWidth") <= width
        assert tab.ask(CUT) == []
        assert tab.page.evaluate(ROWS, "cyan") == rows


WITH_BADGES = """() => {
    for (const badge of document.querySelectorAll(".badge")) {
        badge.textContent = "second yellow";
        badge.hidden = false;
    }
    return [...document.querySelectorAll(".panel .who, .panel .badge")]
        .filter((one) => one.checkVisibility() && one.scrollWidth > one.clientWidth + 1).map((one) => one.textContent);
}"""


def test_a_badge_is_whole_in_every_panel(crowd, visit) -> None:
    tab = visit(crowd, "referee")
    tab.until("document.querySelectorAll('.panel').length === 22")
    for width in (1440, 1100, 390):
        tab.resize(width)
        if width < 1000:
            tab.open("robots")
        assert tab.page.evaluate(WITH_BADGES) == []


LABELLED = """async (first) => {
    const { drawRoleLabels } = await import("/field/role_labels.js");
    const places = { a: [0, 0], b: [1.2, 0], c: [6, 4], d: [6, 3.2] };
    const bodies = Object.entries(places).map(([name, [x, y]]) => ({ name, truth: { x, y }, radius: 0.25 }));
    const labels = bodies.filter(({ name }) => name !== "d").map((body) => ({ ...body, text: "right supporter" }));
    const context = document.createElement("canvas").getContext("2d");
    return drawRoleLabels(context, window.touchline.pitchCanvas.projection, labels, bodies, new Set(first));
}"""


def test_labels_of_roles_cover_neither_each_other_nor_a_robot(crowd, visit) -> None:
    """Of two side by side one has a label, one with another right below it none; a chosen one has it in any case."""
    tab = visit(crowd, "referee")
    tab.until("window.touchline.pitchCanvas.labelled.length > 12")
    assert tab.page.evaluate(LABELLED, []) == ["a"]
    assert tab.page.evaluate(LABELLED, ["b", "c"]) == ["b", "c"]
    for robot in ("cyan4", "magenta11"):
        tab.ask(f"window.touchline.selection.choose('{robot}')")
        tab.until(f"window.touchline.pitchCanvas.labelled.includes('{robot}')")


def test_the_brackets_choose_all_robots_of_both_sides_one_after_the_other(crowd, visit) -> None:
    tab = visit(crowd)
    chosen = []
    for _ in NAMES:
        tab.page.keyboard.press("]")
        chosen.append(tab.ask("window.touchline.selection.robot"))
    assert chosen == NAMES


def test_a_number_of_two_digits_is_narrower_than_its_robot(crowd, visit) -> None:
    tab = visit(crowd)
    for size in (1440, 390):
        tab.resize(size)
        wide, across = tab.ask("""(async () => {
            const { drawnRadius, numberSize } = await import("/shared/bodies.js");
            const { plateOf } = await import("/shared/shapes.js");
            const { projection, match } = window.touchline.pitchCanvas;
            const radius = drawnRadius(projection, match.radiusOf("cyan10")), size = numberSize("10", radius);
            const plate = plateOf(document.createElement("canvas").getContext("2d"), "10", 0, 0, size, 700);
            return [plate.right - plate.left - 0.7 * size, 1.8 * radius];
        })()""")
        assert wide < across
