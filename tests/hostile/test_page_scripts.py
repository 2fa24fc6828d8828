"""Script in names and texts: none runs, and none becomes an element, in the page and in a match's statistics."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser

from coach_gateway.web.pages.match_result import FILE
from recordings.reading.recording import open_recording
from recordings.soccer.stats.page import page_of
from schemas.config.match_config import MatchConfig, load_match
from schemas.messages.coach import CoachOrder
from schemas.messages.health import Health
from schemas.messages.radio import Radio
from schemas.messages.soccer.game import GameEvent
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase
from schemas.topics import EVENT, HEALTH
from support.fake_host import FakeHost
from support.in_process_bus import SharedState
from support.page_gateway import Gateway
from support.recorded_match import record_match
from support.tab import Tab

SCRIPTS = (
    "<img src=x onerror=steal()>",
    "<script>steal()</script>",
    "</script><script>steal()</script>",
    '"><svg/onload=steal()>',
    "javascript:steal()",
    "{{STYLE}}${steal()}`'\\\"&lt;b&gt;\u2028]]>",
    "<a href=javascript:steal()>Sieg</a>",
    "\u202egnirob\x1b[2J<iframe srcdoc='<script>parent.steal()</script>'>",
)
ELEMENTS = "[...document.querySelectorAll('img, iframe, svg[onload], a[href^=javascript], object, embed')].length"
TABS = ("match", "coach", "drive", "settings", "host", "log")


@pytest.fixture
def hostile_host(medium: SharedState) -> Iterator[FakeHost]:
    """A host whose match has script in every free text."""
    config = load_match(
        None, {f"teams.{side}.{key}": value for side in Side for key, value in (("size", 2), ("name", SCRIPTS[0][:40]))}
    )
    host = FakeHost(medium, config, in_threads=True)
    yield host
    host.close()


def say_everything(host: FakeHost) -> None:
    """Publish script in each text of a match that the page shows."""
    host.say(phase=Phase.PLAY, running=True)
    at: dict[str, Any] = {"tick": host.state.tick, "time": host.state.time}
    kinds = (EventKind.ACTION, EventKind.GOAL, EventKind.FOUL, EventKind.PROPOSAL)
    for number, script in enumerate(SCRIPTS):
        host.put(
            EVENT,
            GameEvent(**at, clock=1.0, kind=kinds[number % len(kinds)], rule=script[:40], text=script, side=Side.CYAN),
        )
    for robot in ("cyan1", "cyan2", "magenta1"):
        script = SCRIPTS[3]
        host.believe(robot, Radio(role=script[:32], intention=script[:32], extra={script[:32]: script[:32]}))
    order = CoachOrder(sequence=7, tactic=SCRIPTS[0][:32])
    host.stand(Side.CYAN, order, {"cyan1": SCRIPTS[1]}, cyan1=True)
    host.put(HEALTH, Health(**at, pace="realtime", real_time_factor=1.0))
    host.show()


def test_no_script_in_a_text_of_the_match_runs_in_the_page(
    hostile_host: FakeHost, gateway_of: Callable[..., Gateway], browser: Browser, tmp_path: Path
) -> None:
    result = {
        "kind": "result",
        "figures": [[SCRIPTS[0], SCRIPTS[1], SCRIPTS[2]]],
        "statistics": None,
        "replay": SCRIPTS[0],
    }
    folder = tmp_path / "result"
    folder.mkdir()
    gateway = gateway_of(result=folder)
    say_everything(hostile_host)
    context = browser.new_context(viewport={"width": 1360, "height": 900})
    context.add_init_script("window.stolen = 0; window.steal = () => { window.stolen += 1; };")
    requests: list[str] = []
    context.on("request", lambda request: requests.append(request.url))
    tab = Tab(context, gateway.origin, "referee")
    (folder / FILE).write_text(json.dumps(result))
    say_everything(hostile_host)
    tab.until("document.body.textContent.includes('onerror=steal()')")
    for name in TABS:
        tab.open(name)
        tab.page.wait_for_timeout(20)
        assert tab.ask(ELEMENTS) == 0, name
    texts = tab.ask("document.body.textContent")
    assert all(script in texts for script in SCRIPTS[:3])  # shown as what it is
    assert tab.ask("window.stolen") == 0
    assert tab.faults == []
    assert all(url.startswith((gateway.origin, "data:")) for url in requests)
    context.close()


@pytest.fixture
def hostile_recording(tmp_path: Path) -> Path:
    """A recording of a match whose teams have script for names, and send it."""
    path = tmp_path / "match.mcap"
    shouting = "support.shouting:Shouting"
    teams = {
        side: {"name": SCRIPTS[2 + number], "brain": shouting, "size": 1} for number, side in enumerate(map(str, Side))
    }
    record_match(path, MatchConfig.model_validate({"seed": 7, "duration": 2.0, "teams": teams}), until=600.0)
    return path


def test_no_script_in_a_text_of_a_recording_runs_in_its_statistics(
    browser: Browser, hostile_recording: Path, tmp_path: Path
) -> None:
    path = tmp_path / "match.html"
    path.write_text(page_of(open_recording(hostile_recording))[1], "utf-8")
    context = browser.new_context(viewport={"width": 1360, "height": 900})
    context.set_offline(True)
    context.add_init_script("window.stolen = 0; window.steal = () => { window.stolen += 1; };")
    page = context.new_page()
    faults: list[str] = []
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("dialog", lambda dialog: faults.append(dialog.message))
    page.goto(path.as_uri())
    page.wait_for_function("window.touchline !== undefined")
    assert page.evaluate(ELEMENTS) == 0
    assert SCRIPTS[2] in page.evaluate("document.body.textContent")  # shown as what it is
    assert page.evaluate("window.stolen") == 0 and faults == []
    context.close()
