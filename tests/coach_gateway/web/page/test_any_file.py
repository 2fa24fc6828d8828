"""A file without a match on the page: its time line and its topics, and nothing of a field."""

import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from recordings.reading.log_order import open_log
from recordings.replay.log_replay import Keys, LogReplay
from recordings.replay.replay import ReplaySettings
from runtime.bus.contract import Bus, PresenceKind
from runtime.bus.zenoh.any_keys import open_network
from runtime.process.clock import Clock, WallClock
from support.foreign import drive, write_mcap
from support.page_gateway import SOON
from support.tab import Tab

SHOWN = "window.touchline.match.replay !== null"


class ReplayedFile:
    """A log that is replayed, paused, on a network of its own, which a page joins."""

    def __init__(self, path: Path) -> None:
        self.medium = self
        settings = ReplaySettings(path, paused=True, stay=True)
        self._bus = open_network("friendly", WallClock(), None, "tcp/127.0.0.1:0")
        self._bus.declare_alive(PresenceKind.HOST, "host")
        self.replay = LogReplay(self._bus, open_log([path], Keys(settings).of), settings)
        self._thread = threading.Thread(target=self.replay.run)
        self._thread.start()

    def open_bus(self, name: str, clock: Clock) -> Bus:
        return open_network(name, clock, self._bus.endpoint, None)

    def close(self) -> None:
        self.replay.player.ended = True
        self._thread.join(SOON)
        self._bus.close()


@pytest.fixture
def log(tmp_path: Path) -> Iterator[ReplayedFile]:
    """Ten minutes with 1 message in 100 ms, and a topic that begins in the middle."""
    map_of = [("/map", 1000 * at, b"{}") for at in range(300, 304)]
    log = ReplayedFile(write_mcap(tmp_path / "log.mcap", [*drive(6001, step=100), *map_of]))
    yield log
    log.close()


def seen(tab: Tab) -> list[str]:
    """Ids of the large parts that are seen."""
    parts = ("replay", "go", "topic-rows", "moving", "marks", "layers", "robots", "events-panel", "pending", "next")
    return [part for part in parts if tab.page.locator(f"#{part}").is_visible()]


def test_a_file_without_a_match_has_its_time_line_and_topics_and_nothing_of_a_field(log, visit) -> None:
    tab = visit(log, "referee", shown=SHOWN)
    rows = tab.ask(
        "[...document.querySelectorAll('#topic-rows tr')].map((row) => row.innerText.split(/\\s+/).join(' '))"
    )
    assert rows == ["map json any 4 1.0 5:00.0", "robot1/odom json any 6001 10.0 0:00.0"]
    assert tab.page.locator("#moment").inner_text() == "0:00.0 of 10:00.0"
    assert tab.page.locator("#phase").inner_text() == "Paused"
    for width, height in ((1366, 768), (390, 844), (844, 390)):
        tab.resize(width, height)
        assert seen(tab) == ["replay", "go", "topic-rows"]
        assert tab.ask("document.documentElement.scrollWidth <= innerWidth")
        assert tab.ask(
            "[...document.querySelectorAll('.match-state > *')].every((one) => one.scrollWidth <= one.clientWidth)"
        )
        for control in ("play", "step", "loop", "rate", "go-to", "scrub"):
            box = tab.page.locator(f"#{control}").bounding_box()
            assert box["x"] >= 0 and box["x"] + box["width"] <= width and box["y"] + box["height"] <= height


def test_the_time_line_of_a_file_is_played_sought_looped_and_paced(log, visit) -> None:
    tab, player = visit(log, "referee", shown=SHOWN), log.replay.player
    tab.page.locator("#scrub").fill("120")
    tab.until("document.getElementById('moment').textContent.startsWith('2:00.0')")
    tab.page.locator("#go-to").fill("59.5")
    tab.page.keyboard.press("Enter")
    tab.until("document.getElementById('clock').textContent === '0:59.5'")
    assert player.position_ns == 59_500_000_000
    tab.page.locator("#topic-rows button").first.click()
    tab.until("document.getElementById('clock').textContent === '5:00.0'")
    tab.page.locator("#rate").select_option("100")
    tab.until("window.touchline.match.replay.rate === 100")
    tab.page.locator("#loop").click()
    tab.until("window.touchline.match.replay.loop")
    assert player.published == 0
    tab.page.locator("#play").click()
    tab.until("document.getElementById('phase').textContent === 'Playing'")
    tab.until("window.touchline.match.replay.messages > 10 && window.touchline.match.replay.time > 310")
    tab.page.keyboard.press("Space")
    tab.until("document.getElementById('phase').textContent === 'Paused'")
    assert player.paused


def test_who_watches_a_file_sees_its_topics_and_controls_nothing(log, visit) -> None:
    tab = visit(log, shown=SHOWN)
    assert seen(tab) == ["replay", "topic-rows"]
    assert tab.page.locator(".topics button, #play, #loop, #rate").filter(visible=True).count() == 0
    tab.page.keyboard.press("Space")
    tab.page.wait_for_timeout(300)
    assert log.replay.player.paused


def test_the_keys_of_a_file_are_those_of_its_time_line(log, visit) -> None:
    tab = visit(log, "referee", shown=SHOWN)
    tab.page.keyboard.press("?")
    keys = tab.page.locator("#help dt").filter(visible=True).all_inner_texts()
    assert keys == ["space", "?", "← →", ", .", "enter"]
    assert "robot" not in tab.page.locator("#help").inner_text().lower()
    tab.page.keyboard.press("Escape")
    tab.page.keyboard.press("Shift+ArrowRight")
    tab.until("document.getElementById('clock').textContent === '0:10.0'")


def test_a_rate_that_the_page_does_not_offer_is_shown(log, visit) -> None:
    log.replay.player._playback = log.replay.player._playback.changed(0, 0.0, rate=7.5)
    tab = visit(log, "referee", shown=SHOWN)
    tab.until("document.getElementById('rate').value === '7.5'")
    assert tab.ask("document.getElementById('rate').selectedOptions[0].textContent") == "7.5×"
