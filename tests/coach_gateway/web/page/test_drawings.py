"""What brains draw, on the page: their shapes, their values, and who sees them; and a sensor's readings."""

import time
from pathlib import Path

import pytest

from support.page_gateway import SOON

DRAWN = {"cyan": {"name": "Blues", "brain": "support.drawing_brain:DrawingBrain", "size": 1}}
TEAMS = DRAWN | {"magenta": {"name": "Reds", "brain": "support.drawing_brain:DrawingBrain", "size": 1}}
SHAPES = [(2.0, 5.0), (6.0, -3.0), (7.5, 2.0), (2.0, -6.0)]
"""A place on the point, the line, the circle and the polygon, in the team frame."""

RED = """([x, y]) => {
    const { projection } = window.touchline.pitchCanvas, canvas = document.getElementById("moving");
    const [left, top] = [projection.x(x), projection.y(y)].map((at) => Math.round(at * projection.density));
    const { data } = canvas.getContext("2d").getImageData(left - 4, top - 4, 9, 9);
    const isRed = (at) => data[at] > 240 && data[at + 1] < 30 && data[at + 3] > 200;
    return [...Array(81).keys()].some((pixel) => isRed(4 * pixel));
}"""


def shown(tab, sign: int) -> list[bool]:
    """Whether each shape is drawn for a side that attacks in this direction."""
    return [tab.page.evaluate(RED, [sign * x, sign * y]) for x, y in SHAPES]


def wait_for_shapes(tab, cyan: bool, magenta: bool) -> None:
    """Until the shapes of exactly these sides are drawn."""
    deadline = time.monotonic() + SOON
    while (shown(tab, 1), shown(tab, -1)) != ([cyan] * 4, [magenta] * 4):
        assert time.monotonic() < deadline, (shown(tab, 1), shown(tab, -1))
        tab.page.wait_for_timeout(20)


def test_drawings_can_be_switched_off_and_limited_to_a_robot(match_of, visit) -> None:
    tab = visit(match_of(teams=TEAMS), "referee")
    tab.until("document.querySelectorAll('#layer-drawings option').length === 6")
    choice = tab.page.locator("#layer-drawings")
    assert choice.input_value() == "none"  # both teams' would hide the match
    for value, cyan, magenta in (("none", False, False), ("magenta1", False, True), ("cyan", True, False)):
        choice.select_option(value)
        wait_for_shapes(tab, cyan, magenta)


def test_the_values_of_the_chosen_robot_are_listed(match_of, visit) -> None:
    tab = visit(match_of(teams=TEAMS), "referee")
    assert not tab.page.locator("#debug").is_visible()
    tab.page.locator("[data-robot=magenta1] .who").click()
    tab.until("document.getElementById('debug').innerText.includes('plan')")
    values = tab.page.locator("#debug-values")
    assert tab.page.locator("#debug-robot").inner_text() == "magenta1"
    assert values.locator("dt").all_inner_texts() == ["tick", "gap", "plan"]
    assert values.locator("dd").all_inner_texts()[1:] == ["0.25", "wait"]
    before = values.locator("dd").first.inner_text()
    tab.until(f"document.querySelector('#debug-values dd').textContent !== '{before}'")


def test_a_coach_sees_what_its_robots_draw_at_once(match_of, visit) -> None:
    tab = visit(match_of(teams=TEAMS), "cyan")
    tab.until("document.querySelectorAll('#layer-drawings option').length === 4")
    assert tab.page.locator("#layer-drawings").input_value() == "all"
    wait_for_shapes(tab, cyan=True, magenta=False)


def test_a_replay_offers_the_drawings_of_both_teams_to_all_pages(record, replay_file, visit) -> None:
    tab = visit(replay_file(record(duration=2.0, teams=TEAMS)))
    tab.until("Object.keys(window.touchline.match.debug).length === 2")
    tick = tab.ask("window.touchline.pitchCanvas.world.tick")
    assert tab.ask("window.touchline.match.debug.cyan1.debug.values.tick") == pytest.approx(tick, abs=1)
    wait_for_shapes(tab, cyan=False, magenta=False)
    tab.page.locator("#layer-drawings").select_option("all")
    wait_for_shapes(tab, cyan=True, magenta=True)


PROFILE = """
extends = "msl"
[robot.sensors.front]
kind = "range"
beams = { value = 1, unit = "1", origin = "test" }
span = { value = 0.1, unit = "rad", origin = "test" }
max_distance = { value = 100.0, unit = "m", origin = "test" }
"""

BEAM = """(away) => {
    const { projection, world } = window.touchline.pitchCanvas, canvas = document.getElementById("moving");
    const { x, y, heading } = world.robots.magenta1;
    const spot = [projection.x(x + away * Math.cos(heading)), projection.y(y + away * Math.sin(heading))];
    const [left, top] = spot.map((at) => Math.round(at * projection.density));
    const { data } = canvas.getContext("2d").getImageData(left - 2, top - 2, 5, 5);
    return [...Array(25).keys()].some((pixel) => data[4 * pixel + 3] > 40);
}"""


def test_a_beam_is_drawn_from_the_chosen_robot_to_what_it_met(officiated, visit, tmp_path: Path) -> None:
    (tmp_path / "sensing.toml").write_text(PROFILE)
    tab = visit(officiated(still=True, profile=str(tmp_path / "sensing.toml")))
    tab.until("window.touchline.pitchCanvas.world !== null")
    assert not tab.page.evaluate(BEAM, 3.0)
    tab.page.locator("[data-robot=magenta1] .who").click()
    tab.until(f"({BEAM})(3.0) && ({BEAM})(0.8)")
    tab.page.locator("[data-robot=magenta1] .who").click()
    tab.until(f"!({BEAM})(3.0)")
