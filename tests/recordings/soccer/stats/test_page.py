"""The page in a real browser: what is drawn is what was recorded, wherever one jumps."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from recordings.reading.recording import Recording, open_recording
from recordings.soccer.stats.figures import MatchFigures
from recordings.soccer.stats.page import page, page_of, write_page
from schemas.errors import TouchlineError
from schemas.messages.world import World

FILLS = {"cyan": (0x28, 0xB9, 0xDC), "magenta": (0xEF, 0x4F, 0xA0)}

PIXEL = """([x, y]) => {
    const canvas = document.getElementById("pitch"), context = canvas.getContext("2d");
    const { projection } = window.touchline.view;
    const at = [projection.x(x), projection.y(y)].map((pixel) => Math.round(pixel * projection.density));
    return [...context.getImageData(...at, 1, 1).data].slice(0, 3);
}"""


@pytest.fixture(scope="module")
def recording(played: Path) -> Recording:
    return open_recording(played)


@pytest.fixture(scope="module")
def made(recording: Recording, tmp_path_factory: pytest.TempPathFactory) -> tuple[MatchFigures, Path]:
    figures, text = page_of(recording)
    path = tmp_path_factory.mktemp("page") / "new" / "match.html"
    write_page(path, text)
    return figures, path


class Opened:
    """A page in a tab, and what it complained of."""

    def __init__(self, browser: Browser, path: Path, width: int = 1360, height: int = 900) -> None:
        self.context = browser.new_context(viewport={"width": width, "height": height})
        self.context.set_offline(True)
        self.page: Page = self.context.new_page()
        self.faults: list[str] = []
        self.requests: list[str] = []
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("console", lambda said: self.faults.append(said.text) if said.type == "error" else None)
        self.page.on("dialog", lambda dialog: self.faults.append(dialog.message))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(path.as_uri())
        self.until("window.touchline !== undefined && document.getElementById('pitch').style.height !== ''")

    def until(self, holds: str) -> None:
        """Wait; the page's content security policy forbids evaluating text in it, so it is polled from outside."""
        for _ in range(500):
            if self.page.evaluate(holds):
                return
            self.page.wait_for_timeout(20)
        raise AssertionError(f"never came true: {holds}")

    @property
    def time(self) -> float:
        return float(self.page.evaluate("window.touchline.player.time"))

    def scrub(self, time: float) -> None:
        self.page.locator("#scrub").fill(str(time))

    def shows(self, robot: str, world: World) -> bool:
        """Whether this robot's colour is drawn beside its number, where the world has it."""
        place = world.robots[robot]
        side = "cyan" if robot.startswith("cyan") else "magenta"
        around = [(0.2, 0.1), (-0.2, 0.1), (0.2, -0.1), (-0.2, -0.1)]
        pixels = [self.page.evaluate(PIXEL, [place.x + dx, place.y + dy]) for dx, dy in around]
        return sum(all(abs(a - b) < 12 for a, b in zip(pixel, FILLS[side], strict=True)) for pixel in pixels) >= 2


@pytest.fixture
def opened(browser: Browser, made: tuple[MatchFigures, Path]) -> Iterator[Opened]:
    tab = Opened(browser, made[1])
    yield tab
    assert tab.faults == []
    tab.context.close()


def world_at(recording: Recording, time: float) -> World:
    return next(world for _, world in recording.decoded("world", start=time - 0.011))


def free(world: World) -> list[str]:
    """Robots that stand clear of each other and of the ball, so that nothing is drawn over them."""
    places = {name: (robot.x, robot.y) for name, robot in world.robots.items()} | {"ball": (world.ball.x, world.ball.y)}
    return [
        name
        for name in world.robots
        if all(
            abs(x - places[name][0]) > 1.2 or abs(y - places[name][1]) > 1.2
            for other, (x, y) in places.items()
            if other != name
        )
    ]


def test_the_page_opens_from_disk_without_asking_for_anything(opened: Opened, made: tuple[MatchFigures, Path]) -> None:
    assert opened.requests == [made[1].as_uri()]
    assert opened.page.title() == "Simple – NuBot"
    assert "://" not in made[1].read_text("utf-8").split('<script type="application/json"')[0]


def test_the_scrubber_moves_the_robots_to_where_they_were(opened: Opened, recording: Recording) -> None:
    seen: dict[str, set[tuple[float, float]]] = {}
    for time in (0.0, 6.0, 12.4, 19.2, 23.0):
        opened.scrub(time)
        assert opened.time == pytest.approx(time)
        world = world_at(recording, time)
        clear = free(world)
        assert len(clear) >= 3
        assert [name for name in clear if not opened.shows(name, world)] == []
        for name in clear:
            seen.setdefault(name, set()).add((round(world.robots[name].x, 1), round(world.robots[name].y, 1)))
    assert sum(len(places) > 1 for places in seen.values()) >= 3  # they had moved in between


def test_an_event_jumps_there_and_the_robots_with_it(opened: Opened, recording: Recording) -> None:
    opened.page.locator("#all-events").click()
    rows = opened.page.locator("#events button")
    told = opened.page.evaluate("window.touchline.match.events.map((event) => event.time)")
    assert rows.count() == len(told) >= 3
    number = len(told) - 1
    rows.nth(number).click()
    assert opened.time == pytest.approx(told[number] - 2.0)
    world = world_at(recording, opened.time)
    assert [name for name in free(world) if not opened.shows(name, world)] == []
    opened.page.keyboard.press("p")
    assert opened.time < told[number] - 2.0
    before = opened.time
    opened.page.keyboard.press("n")
    assert opened.time > before


def test_events_call_the_teams_by_their_names(opened: Opened, recording: Recording) -> None:
    opened.page.locator("#all-events").click()
    texts = opened.page.locator("#events .what").all_text_contents()
    assert [text for text in texts if re.search(r"\b(cyan|magenta)\b", text)] == []
    assert recording.manifest.setup is not None
    for team in recording.manifest.setup.teams.values():
        assert any(re.search(rf"\b{team.name}\b", text) for text in texts)


def test_the_clock_and_the_phase_are_those_of_the_moment(opened: Opened, recording: Recording) -> None:
    for time in (0.5, 8.0, 23.9):
        opened.scrub(time)
        world = world_at(recording, time)
        minutes, seconds = divmod(world.clock, 60)
        shown = opened.page.locator("#clock").inner_text()
        told_minutes, told_seconds = shown.split(":")
        assert int(told_minutes) == int(minutes) and float(told_seconds) == pytest.approx(seconds, abs=0.25)
        *_, state = [state for _, state in recording.decoded("game/state", end=time)]
        assert opened.page.locator("#phase").inner_text().startswith(state.phase.value.replace("_", " "))
        assert opened.page.locator("#score-now").inner_text() == f"{state.score.cyan} : {state.score.magenta}"


def test_it_plays_pauses_and_changes_speed_by_keys_and_buttons(opened: Opened) -> None:
    opened.page.keyboard.press("ArrowRight")
    assert opened.time == pytest.approx(1.0)
    opened.page.keyboard.press("Shift+ArrowRight")
    assert opened.time == pytest.approx(11.0)
    opened.page.keyboard.press(".")
    assert opened.time == pytest.approx(11.04)
    opened.page.keyboard.press("Home")
    assert opened.time == 0.0
    for _ in range(2):
        opened.page.keyboard.press("ArrowUp")
    assert opened.page.evaluate("window.touchline.player.rate") == 4
    opened.page.keyboard.press("Space")
    opened.until("window.touchline.player.time > 2")
    assert opened.page.locator("#play").get_attribute("aria-label") == "Pause (space)"
    opened.page.locator("#play").click()
    stopped = opened.time
    opened.page.wait_for_timeout(100)
    assert opened.time == stopped
    opened.page.keyboard.press("End")
    assert opened.time == pytest.approx(24.0)


def test_pointing_at_the_momentum_jumps_there(opened: Opened) -> None:
    box = opened.page.locator("#momentum").bounding_box()
    assert box is not None
    opened.page.mouse.click(box["x"] + 0.25 * box["width"], box["y"] + 20)
    assert opened.time == pytest.approx(6.0, abs=0.1)


def test_the_figures_of_the_page_are_those_of_the_table(opened: Opened, made: tuple[MatchFigures, Path]) -> None:
    pairs = opened.page.locator(".pair")
    texts = [pairs.nth(number).inner_text().split("\n") for number in range(pairs.count())]
    figures, _ = made
    (possession,) = [text for text in texts if "possession" in text]
    assert [f"{100 * side.possession:.0f} %" for side in figures.sides.values()] == [possession[0], possession[2]]
    assert opened.page.locator("#robots tbody tr").count() == 10
    assert opened.page.locator("#heat figure").count() == 11


def test_a_keepers_heat_is_at_its_own_goal_on_the_left(opened: Opened) -> None:
    for keeper in ("cyan1", "magenta1"):
        light = opened.page.evaluate(
            """(name) => {
                const canvas = document.querySelector(`[data-body=${name}] canvas`);
                const context = canvas.getContext("2d"), { width, height } = canvas;
                const sum = (x) => context.getImageData(x, height * 0.35, width * 0.12, height * 0.3).data
                    .reduce((all, value, place) => all + (place % 4 === 3 ? 0 : value), 0);
                return [sum(width * 0.04), sum(width * 0.84)];
            }""",
            keeper,
        )
        assert light[0] > 1.5 * light[1]


@pytest.mark.parametrize("width", [320, 390, 768])
def test_a_phone_shows_the_whole_page_without_scrolling_sideways(
    browser: Browser, made: tuple[MatchFigures, Path], width: int
) -> None:
    tab = Opened(browser, made[1], width, 844)
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= width
    for name in ("#pitch", "#scrub", "#play", "#momentum", "#events"):
        box = tab.page.locator(name).bounding_box()
        assert box is not None and box["x"] >= 0 and box["x"] + box["width"] <= width
    assert tab.faults == []
    tab.context.close()


def test_a_link_opens_the_page_at_a_time(browser: Browser, made: tuple[MatchFigures, Path]) -> None:
    tab = Opened(browser, made[1])
    tab.page.goto("about:blank")
    tab.page.goto(f"{made[1].as_uri()}#t=8.5")
    tab.until("window.touchline !== undefined")
    assert tab.time == 8.5
    tab.context.close()


def test_a_page_of_a_recording_with_little_evidence_names_what_is_missing(
    browser: Browser, script: Any, tmp_path: Path
) -> None:
    script.rest(5)
    script.messages = [(time, message) for time, message in script.messages if not hasattr(message, "phase")]
    write_page(tmp_path / "little.html", page(script.content()))
    tab = Opened(browser, tmp_path / "little.html")
    assert tab.page.locator("#score").inner_text() == "– : –"
    assert tab.page.locator("#remarks li").count() == 4
    tab.page.keyboard.press("n")
    tab.scrub(0.3)
    assert tab.time == 0.3
    assert tab.faults == []
    tab.context.close()


def test_names_are_shown_as_they_are_and_never_run(
    browser: Browser, recording: Recording, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    evil = "</script><img src=x onerror=alert(1)><b>"
    setup = recording.manifest.setup
    assert setup is not None
    teams = {side: team.replace(name=evil) for side, team in setup.teams.items()}
    manifest = recording.manifest.replace(setup=setup.replace(teams=teams))
    monkeypatch.setattr(recording, "manifest", manifest)
    _, text = page_of(recording)
    write_page(tmp_path / "evil.html", text)
    tab = Opened(browser, tmp_path / "evil.html")
    assert tab.page.locator("#cyan-name").inner_text() == evil
    assert tab.page.locator("img").count() == 0
    assert tab.faults == []
    tab.context.close()


def test_a_page_that_cannot_be_written_is_reported_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(TouchlineError, match=r"--html .*file/page\.html: .*; give a path that can be written"):
        write_page(tmp_path / "file" / "page.html", "")


def test_the_headline_is_the_final_score_at_any_moment(opened: Opened, recording: Recording) -> None:
    *_, final = [state for _, state in recording.decoded("game/state")]
    for time in (0.0, 12.0, 24.0):
        opened.scrub(time)
        assert opened.page.locator("#score").inner_text() == f"{final.score.cyan} : {final.score.magenta}"


@pytest.mark.parametrize("width", [390, 1360])
def test_the_knob_stands_above_the_cursor(browser: Browser, made: tuple[MatchFigures, Path], width: int) -> None:
    tab = Opened(browser, made[1], width, 844)
    start, end = tab.page.evaluate("[window.touchline.match.start, window.touchline.match.end]")
    cursor = tab.page.locator("#momentum").bounding_box()
    scrub = tab.page.locator("#scrub").bounding_box()
    assert cursor is not None and scrub is not None
    for share in (0.0, 0.25, 0.8, 1.0):
        tab.scrub(start + share * (end - start))
        knob = scrub["x"] + 8 + share * (scrub["width"] - 16)  # the knob is 16 px wide
        assert knob == pytest.approx(cursor["x"] + share * cursor["width"], abs=1.0)
    tab.context.close()


def test_the_goals_of_all_maps_are_inside_their_pictures(opened: Opened, made: tuple[MatchFigures, Path]) -> None:
    shown = """() => {
        const { pitch } = window.touchline.match, depth = pitch.length / 2 + pitch.goal_depth;
        return [...document.querySelectorAll("#heat canvas, #shots")].map((canvas) => {
            const scale = Number(canvas.dataset.scale);
            return canvas.clientWidth / 2 - depth * scale;
        });
    }"""
    assert all(room > 1.0 for room in opened.page.evaluate(shown))


def test_marks_are_drawn_anew_when_the_colours_of_the_system_change(opened: Opened) -> None:
    mark = """() => {
        const { width, height } = document.getElementById("momentum");
        const { data } = document.getElementById("momentum").getContext("2d").getImageData(0, height / 2, width, 1);
        return [data[4 * 3], data[4 * 3 + 1], data[4 * 3 + 2]];
    }"""
    opened.page.emulate_media(color_scheme="light")
    opened.until(f"(({mark})())[0] < 128")
    opened.page.emulate_media(color_scheme="dark")
    opened.until(f"(({mark})())[0] > 128")


def test_print_keeps_bars_and_colours(opened: Opened) -> None:
    opened.page.emulate_media(media="print")
    kept = "[...document.querySelectorAll('.share i, .mark')].map((one) => getComputedStyle(one).printColorAdjust)"
    assert set(opened.page.evaluate(kept)) == {"exact"}
    assert not opened.page.locator("#scrub").is_visible()
    assert opened.page.evaluate("getComputedStyle(document.getElementById('events')).overflowY") == "visible"


def test_paper_of_another_width_is_printed_without_an_error(browser: Browser, made: tuple[MatchFigures, Path]) -> None:
    """Its time line is not printed, and has no size."""
    tab = Opened(browser, made[1])
    tab.page.emulate_media(media="print")
    tab.page.set_viewport_size({"width": 700, "height": 900})
    tab.until("document.getElementById('momentum').width < 700")
    tab.page.evaluate("window.touchline.player.seek(3.0)")
    assert tab.faults == []
    tab.context.close()


def test_a_phone_shows_all_columns_of_the_robots(browser: Browser, made: tuple[MatchFigures, Path]) -> None:
    tab = Opened(browser, made[1], 390, 844)
    last = tab.page.locator("#robots thead th").last.bounding_box()
    assert last is not None and last["x"] + last["width"] <= 390
    tab.context.close()
    narrow = Opened(browser, made[1], 300, 700)
    room = narrow.page.evaluate(
        "(() => { const box = document.querySelector('.scroll'); box.scrollLeft = 1000;"
        " const last = document.querySelector('#robots thead th:last-child').getBoundingClientRect();"
        " return box.getBoundingClientRect().right - last.right; })()"
    )
    assert room >= -1.0  # it scrolls to its last column
    narrow.context.close()
