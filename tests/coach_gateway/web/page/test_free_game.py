"""The page of a free game: floor, zones, what can be pushed and the score; no ball, no goals, no referee."""

from pathlib import Path
from typing import Any

import pytest

from support.free_match import BOX, SCORE, free_match, record_free_match, scene

ZONES = [
    {"name": "dock", "place": [5.0, 5.0], "radius": 1.0},
    {"name": "lane", "place": [-6.0, 2.0], "size": [3.0, 1.0]},
]
SOCCER = {
    "description": "A test.",
    "ball": {"x": 1.0, "y": 0.0},
    "robots": [{"name": "cyan1", "side": "cyan", "x": 0.0, "y": 0.0}],
}
SHADES = """([x, y, layer]) => {
    const { projection } = window.touchline.pitchCanvas, canvas = document.getElementById(layer);
    const at = [projection.x(x), projection.y(y)].map((pixel) => Math.round(pixel * projection.density));
    return [...canvas.getContext("2d").getImageData(...at, 1, 1).data].slice(0, 3).reduce((a, b) => a + b);
}"""


def words(folder: Path, program: str = SCORE, **more: Any) -> dict[str, Any]:
    """The match: the box lies at (1, 0), a shelf stands at (−4, −3)."""
    shelf = {key: value for key, value in BOX.items() if key not in ("mass", "friction")} | {"name": "shelf"}
    stage = scene()
    stage["obstacles"].append(shelf | {"place": [-4.0, -3.0]})
    settings = {"task.unit": "points", "task.zones": ZONES, "scene": stage, "teams.cyan.name": "Us", **more}
    return free_match(folder, program, **settings).model_dump() | {"name": "friendly", "pace": "realtime"}


@pytest.fixture
def free(match_of, tmp_path: Path) -> Any:
    return match_of(still=True, **words(tmp_path, SCORE.replace("now.tick >= 60", "False"), duration=600.0))


def test_the_score_has_its_unit_and_nothing_of_soccer_is_shown(free, visit) -> None:
    tab = visit(free, "referee")
    tab.until(r"/^1\.\d+ points$/.test(document.getElementById('score').textContent)")
    assert tab.page.title() == "Us"
    hidden = ("#magenta-name", "#half", "#stop", ".ball-says", "#layer-distances", "[data-robot=one] [data-is=ball]")
    hidden += (
        "[data-action=start]",
        "[data-action=goal]",
        "[data-action=take_seat]",
        "[data-action=hold_order][data-side=magenta]",
    )
    assert [one for one in hidden if tab.page.locator(one).first.is_visible()] == []
    assert tab.page.locator("[data-action=hold_order][data-side=cyan]").is_visible()


def test_zones_are_on_the_floor_and_the_box_is_lighter_where_it_has_been_pushed_to(free, visit) -> None:
    tab = visit(free, "referee")
    tab.until("window.touchline.pitchCanvas.world !== null")
    floor = tab.page.evaluate(SHADES, [0.0, -1.0, "ground"])
    assert tab.page.evaluate(SHADES, [0.02, 0.0, "ground"]) == floor  # no halfway line
    assert tab.page.evaluate(SHADES, [-7.3, 1.7, "ground"]) > floor < tab.page.evaluate(SHADES, [5.7, 5.0, "ground"])
    shelf, box = (tab.page.evaluate(SHADES, [x, y, "moving"]) for x, y in ((-4.0, -3.0), (1.0, 0.0)))
    assert box > shelf > floor
    request = "{ operation: 'place', place: [{ body: 'box', x: -2, y: 3 }] }"
    tab.ask(f"window.touchline.connection.ask('scene', {{ request: {request} }})")
    tab.until(f"({SHADES})([-2, 3, 'moving']) === {box} && ({SHADES})([1, 0, 'moving']) !== {box}")


def test_the_pitch_of_soccer_has_the_zones_of_a_task_and_its_score_beside_the_goals(match_of, visit) -> None:
    task = {"score": "tally:plain", "program": SCORE, "unit": "s", "zones": ZONES}
    tab = visit(match_of(still=True, task=task, scene=SOCCER))
    tab.until(r"/^Score \d[.\d]* s$/.test(document.getElementById('half').textContent)")
    assert tab.page.locator("#score").inner_text() == "0 : 0"
    grass = tab.page.evaluate(SHADES, [5.2, -5.0, "ground"])
    assert tab.page.evaluate(SHADES, [5.2, 5.0, "ground"]) > grass


def test_the_result_has_the_score_at_the_end(match_of, visit, tmp_path: Path) -> None:
    tab = visit(match_of(still=True, **words(tmp_path, SCORE.replace("now.tick >= 60", "now.tick >= 200"))))
    tab.until("document.getElementById('result-title').textContent === 'Final result'")
    assert tab.page.locator("#result-score").inner_text().endswith(" points")
    assert tab.page.locator("#result-figures").is_hidden()


def test_a_recording_is_replayed(visit, replay_file, tmp_path: Path) -> None:
    tab = visit(replay_file(record_free_match(tmp_path, free_match(tmp_path))))
    tab.until("window.touchline.pitchCanvas.world?.obstacles.box.x > 1.05")
    tab.until("/^0\\.0\\d+$/.test(document.getElementById('score').textContent)")
