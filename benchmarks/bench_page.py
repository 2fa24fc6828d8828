"""The page in a headless browser: pictures per second with ten robots, and how soon a stop reaches every robot.

A match of ten agent processes in real time, a gateway, one page. The time of a stop runs from the key press to the
first sight with the stopped game that the host sends to the last robot, by the clock of this machine.
"""

import json
import os
import shutil
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Page, sync_playwright
from running_match import launch, running_match

from coach_gateway.settings import GatewaySettings
from coach_gateway.web.settings import WebSettings
from runtime.bus.contract import Bus, Subscription
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.side import Side
from schemas.soccer.game import TeamPhase
from schemas.topics import SIGHT

SECONDS = 8.0
STOPS = 5


def main() -> None:
    """Print both."""
    names = ("chromium-headless-shell", "chromium", "google-chrome")
    chromium = next(filter(None, map(shutil.which, names)), None)
    if chromium is None:
        print("page: not measured, there is no Chromium; apt-get install chromium-headless-shell")
        return
    with (
        running_match("robot_agent.teams.simple:Simple", {"duration": 3600.0, "pace": "realtime"}) as (
            config,
            endpoint,
            *_,
        ),
        tempfile.TemporaryDirectory() as folder,
        open_client(config.name, WallClock(), endpoint, patience=60.0) as bus,
        sync_playwright() as playwright,
    ):
        tokens = Path(folder) / "tokens.json"
        settings = GatewaySettings(connect=endpoint, match=config.name, tokens=tokens, web=WebSettings(port=0))
        gateway = launch("coach_gateway", settings, subprocess.PIPE)
        try:
            address = _address(gateway)
            root = ["--no-sandbox"] if os.geteuid() == 0 else []
            browser = playwright.chromium.launch(executable_path=chromium, args=root)
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            page.goto(f"{address}#token={json.loads(tokens.read_text())['referee']}")
            _until(page, "window.touchline?.match.role === 'referee' && window.touchline.pitchCanvas.world !== null")
            rate = _rate(page)
            reached = [_stop(page, bus, config) for _ in range(STOPS)]
            browser.close()
        finally:
            gateway.terminate()
            gateway.wait()
    print(
        f"page: {rate:.0f} pictures per second with ten robots (at least 30), stop to the last robot's sight "
        f"median {statistics.median(reached):.0f} ms, worst {max(reached):.0f} ms of {STOPS} (at most 100)"
    )


def _address(gateway: subprocess.Popen[bytes]) -> str:
    """The address of the page, as its server prints it."""
    assert gateway.stdout is not None
    for line in map(bytes.decode, gateway.stdout):
        if "http://" in line:
            return "http://" + line.split("http://")[1].split("#")[0].strip().rstrip(";,")
    raise RuntimeError("the gateway ended before it printed the address of its page")


def _rate(page: Page) -> float:
    began, drawn = time.perf_counter(), page.evaluate("window.touchline.pitchCanvas.drawn")
    page.wait_for_timeout(1000 * SECONDS)
    return float((page.evaluate("window.touchline.pitchCanvas.drawn") - drawn) / (time.perf_counter() - began))


def _stop(page: Page, bus: Bus, config: MatchConfig) -> float:
    """Let the game run, stop it by the space bar; ms until the last robot's sight has the stopped game."""
    page.locator("[data-action=drop_ball]").click()
    page.locator("[data-action=start]").click()
    _until(page, "window.touchline.match.state.running && window.touchline.match.state.phase !== 'stopped'")
    robots = [robot for side in Side for robot in config.robots(side)]
    sights = {robot: bus.subscribe(SIGHT, robot=robot) for robot in robots}
    for sight in sights.values():
        while sight.receive(1.0) is None:
            pass
    page.locator("#moving").focus()
    began = time.time_ns()
    page.keyboard.press("Space")
    last = max(_stopped_at(sight, began) for sight in sights.values())
    for sight in sights.values():
        sight.close()
    return (last - began) / 1e6


def _stopped_at(sights: Subscription, began: int) -> int:
    """Wall time in ns at which the host sent a robot's first sight of the stopped game."""
    while (received := sights.receive(10.0)) is not None:
        sent = received.stamp.sent_ns if received.stamp is not None else 0
        if sent > began and received.message().game.phase is TeamPhase.STOPPED:
            return sent
    raise RuntimeError("a robot was never told")


def _until(page: Page, holds: str) -> None:
    while not page.evaluate(holds):
        page.wait_for_timeout(20)


if __name__ == "__main__":
    main()
