"""A match in this process, the gateway's server on loopback before it, and real browsers that look at its page."""

import asyncio
import json
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Locator, Page

from coach_gateway.access.tokens import tokens_of
from coach_gateway.web.binding import bind_page
from coach_gateway.web.server import WebServer
from coach_gateway.web.settings import WebSettings
from coach_gateway.web.waiting_page import WaitingPage
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.record import open_sink
from recordings.recorder.recorder import Recorder
from recordings.recorder.sink import ONE_FILE
from recordings.replay.host import ReplayHost
from recordings.replay.replay import Replay, ReplaySettings
from robot_agent.contract import Briefing, load_brain
from robot_agent.runner import Runner
from schemas.bus.in_process_bus import Medium
from schemas.config.match_config import MatchConfig
from schemas.game import ActionName
from schemas.messages.command import Command
from schemas.messages.game import GameEvent, GameState, RefereeAction
from schemas.messages.replay import ReplayOperation, ReplayRequest
from schemas.messages.sight import Sight
from schemas.process.clock import WallClock
from schemas.side import Side
from schemas.topics import ACTION, EVENT, Topic
from sim_host.server.host import Host

SOON = 30.0
"""s; more than anything takes here, so that only what never comes fails a test."""
TOKENS = {"referee": "the-referee", "cyan": "cyans-coach", "magenta": "magentas-coach"}
TEAMS = {
    "cyan": {"name": "Blues", "brain": "robot_agent.teams.simple:Simple", "size": 2},
    "magenta": {"name": "Reds", "brain": "robot_agent.teams.simple:Simple", "size": 2},
}


class Still:
    """A brain that lets its robot stand."""

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick)


class Match:
    """Host and robots, each side of the bus in a thread of its own; the host can go and come again."""

    def __init__(self, *, still: bool = False, **words: Any) -> None:
        """`still` has all robots stand where they are; the other words are those of the match file."""
        content = {"name": "friendly", "seed": 7, "pace": "realtime", "duration": 600.0, "teams": TEAMS, **words}
        self.config = MatchConfig.model_validate(content)
        self.medium = Medium()
        self._over = threading.Event()
        self._ear = self.medium.open_bus("friendly", WallClock()).subscribe(EVENT)
        self._events: list[GameEvent] = []
        self.start()
        setup = self.host.simulation.setup()
        self._runners = []
        for side in Side:
            for robot in self.config.robots(side):
                bus = self.medium.open_bus("friendly", WallClock())
                briefing = Briefing.of(robot, setup)
                brain = Still() if still else load_brain(self.config.team(side).brain or "", briefing)
                self._runners.append(Runner(bus, brain, robot))
                bus.declare_alive("agent", robot)
        self._robots = threading.Thread(target=self._answer)
        self._robots.start()

    def start(self) -> None:
        """A host begins the match."""
        self._bus = self.medium.open_bus("friendly", WallClock())
        self.host = Host(self.config, self._bus)
        self._hosting = threading.Thread(target=self.host.run)
        self._hosting.start()

    def signal_kick_off(self) -> None:
        """The referee signals the kick-off of the half; in manual officiating people have to give START."""
        start = RefereeAction(action=ActionName.START)
        reply = self.medium.open_bus("friendly", WallClock()).query(ACTION, start, SOON).result(SOON)
        assert reply.accepted, reply.reason

    def stop(self) -> None:
        """The host goes."""
        self.host.stop()
        self._hosting.join(SOON)
        self.host.simulation.close()
        self._bus.close()

    def wait_for_end(self) -> None:
        """Until the match is over."""
        self._hosting.join()

    def close(self) -> None:
        self.stop()
        self._over.set()
        self._robots.join(SOON)

    def until(self, holds: Callable[[], Any]) -> None:
        """Wait until something is true; it is looked at again and again."""
        deadline = time.monotonic() + SOON
        while not holds():
            assert time.monotonic() < deadline, "it never came true"
            time.sleep(0.01)

    @property
    def state(self) -> GameState:
        now = self.host.simulation.now
        state: GameState = self.host.simulation.state.game_state(now.tick, now.time, 1)
        return state

    @property
    def world(self) -> dict[str, Any]:
        world: dict[str, Any] = self.host.simulation.now.world
        return world

    @property
    def events(self) -> list[GameEvent]:
        """All that has happened so far."""
        self._events += [received.message() for received in iter(self._ear.receive, None)]
        return self._events

    def hear(self, topic: Topic) -> Callable[[], list[Any]]:
        """A function for the messages on a topic since its last call."""
        ear = self.medium.open_bus("friendly", WallClock()).subscribe(topic)
        return lambda: [received.message() for received in iter(ear.receive, None)]

    def where(self, robot: str) -> tuple[float, float]:
        truth = self.world["robots"][robot]
        return truth["x"], truth["y"]

    def _answer(self) -> None:
        while not self._over.is_set():
            if not [runner for runner in self._runners if runner.answer_next(0.0)]:
                time.sleep(0.002)


class Gateway:
    """The page's server in a thread of its own; without a medium it waits for a host that does not come."""

    def __init__(self, medium: Medium | None, folder: Path, port: int = 0) -> None:
        tokens = folder / "tokens.json"
        if not tokens.exists():
            tokens.touch(0o600)
            tokens.write_text(json.dumps(TOKENS))
        self.bus = medium.open_bus("friendly", WallClock()) if medium is not None else None
        self._stop = asyncio.Event()
        self._ready = threading.Event()
        self._binding = bind_page(WebSettings(port=port), tokens_of(tokens))
        self.origin = self._binding.origin
        self._thread = threading.Thread(target=self._run)
        self._thread.start()
        assert self._ready.wait(SOON)

    def _run(self) -> None:
        async def main() -> None:
            self._loop = asyncio.get_running_loop()
            waiting_page = WaitingPage(self._binding, "friendly")
            server = WebServer(self.bus, self._binding, lambda _: None) if self.bus is not None else waiting_page
            self._ready.set()
            await server.serve(self._stop)

        asyncio.run(main())

    @property
    def port(self) -> int:
        return int(self.origin.rpartition(":")[2])

    def close(self) -> None:
        if not self._thread.is_alive():
            return
        self._loop.call_soon_threadsafe(self._stop.set)
        self._thread.join(SOON)
        self._binding.listener.close()
        if self.bus is not None:
            self.bus.close()


class Tunnel:
    """A port that forwards to another one until it is blocked: then it silently drops everything."""

    def __init__(self, port: int) -> None:
        self._to = port
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._listener.getsockname()[1])
        self._links: list[tuple[socket.socket, socket.socket]] = []
        self._blocked: list[socket.socket] = []
        self._threads = [threading.Thread(target=self._accept)]
        self._threads[0].start()

    def block(self) -> None:
        """All links that there are; new ones are not."""
        self._blocked += [end for link in self._links for end in link]

    def close(self) -> None:
        for end in (self._listener, *(end for link in self._links for end in link)):
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)
        for thread in self._threads:
            thread.join(SOON)
        for end in (self._listener, *(end for link in self._links for end in link)):
            end.close()

    def _accept(self) -> None:
        with suppress(OSError):
            while True:
                near, _ = self._listener.accept()
                far = socket.create_connection(("127.0.0.1", self._to))
                self._links.append((near, far))
                for ends in ((near, far), (far, near)):
                    self._threads.append(threading.Thread(target=self._pump, args=ends))
                    self._threads[-1].start()

    def _pump(self, begin: socket.socket, end: socket.socket) -> None:
        with suppress(OSError):
            while data := begin.recv(65_536):
                if begin not in self._blocked:
                    end.sendall(data)
            if begin not in self._blocked:
                end.shutdown(socket.SHUT_WR)


class Tab:
    """The page in a browser, and what it complained of."""

    def __init__(self, context: BrowserContext, origin: str, role: str = "spectator") -> None:
        self.context = context
        self.page: Page = context.new_page()
        self.faults: list[str] = []
        self.requests: list[str] = []
        self.loses_its_server = False
        """The browser complains of a server that is not there, and is right."""
        self.origin = origin
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("console", lambda said: self._note(said.text) if said.type == "error" else None)
        self.page.on("dialog", lambda dialog: self.faults.append(dialog.message))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(f"{origin}/#token={TOKENS[role]}" if role in TOKENS else f"{origin}/")
        self.until(f"window.touchline?.match.role === '{role}' && window.touchline.pitchCanvas.world !== null")

    def _note(self, fault: str) -> None:
        if not (self.loses_its_server and "WebSocket connection to" in fault):
            self.faults.append(fault)

    def until(self, holds: str) -> None:
        """Wait for the page; its policy forbids to evaluate a text inside, so it is polled from outside."""
        deadline = time.monotonic() + SOON
        while not self.page.evaluate(holds):
            assert time.monotonic() < deadline, f"never came true: {holds}"
            self.page.wait_for_timeout(20)

    def until_seen(self, body: str, x: float, y: float) -> None:
        """Until the page draws a body, `ball` or `robots.cyan1`, at a place."""
        there = f"window.touchline.pitchCanvas.world.{body}"
        self.until(f"Math.hypot({there}.x - {x}, {there}.y - {y}) < 0.05")

    def ask(self, what: str) -> Any:
        return self.page.evaluate(what)

    def open(self, tab: str) -> None:
        self.page.locator(f"#to-{tab}").click()

    def button(self, action: str, side: str = "") -> Locator:
        return self.page.locator(f'[data-action="{action}"][data-side="{side}"]')

    def logged(self) -> str:
        """The newest line of the log, without its time."""
        line: str = self.page.locator("#log li").first.evaluate("(line) => line.lastChild.textContent.trim()")
        return line

    def wait_for_log(self, text: str) -> None:
        """Until the newest line of the log has this text."""
        self.until(f"document.querySelector('#log li')?.textContent.includes({json.dumps(text)})")

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Where a point of the field is in the window, in pixels."""
        left, top = self.ask(
            f"[window.touchline.pitchCanvas.projection.x({x}), window.touchline.pitchCanvas.projection.y({y})]"
        )
        box = self.page.locator("#moving").bounding_box()
        assert box is not None
        return box["x"] + left, box["y"] + top

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Drag from a point of the field to another."""
        mouse = self.page.mouse
        mouse.move(*self.at(*start))
        mouse.down()
        for share in (0.3, 0.7, 1.0):
            mouse.move(*self.at(*(a + share * (b - a) for a, b in zip(start, end, strict=True))))
        mouse.up()

    def touch(self, kind: str, *fingers: tuple[float, float]) -> None:
        """Fingers in the window, in pixels: `Start`, `Move` or `End`."""
        if not hasattr(self, "_touching"):
            self._touching = self.context.new_cdp_session(self.page)
        points = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(fingers)]
        self._touching.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": points})


@pytest.fixture
def match_of() -> Iterator[Callable[..., Match]]:
    """Makes a match; the words are those of the match file."""
    made: list[Match] = []

    def make(**words: Any) -> Match:
        made.append(Match(**words))
        return made[-1]

    yield make
    for match in made:
        match.close()


@pytest.fixture
def officiated(match_of: Callable[..., Match]) -> Callable[..., Match]:
    """Makes a match that people officiate, its kick-off signalled: only pages change the game."""

    def make(**words: Any) -> Match:
        match = match_of(referee={"mode": "manual"}, **words)
        match.signal_kick_off()
        return match

    return make


@pytest.fixture
def match(officiated: Callable[..., Match]) -> Match:
    """One in which robots take their positions, and play once START is given."""
    return officiated()


@pytest.fixture
def resting(officiated: Callable[..., Match]) -> Match:
    """A match in which no robot moves by itself."""
    return officiated(still=True)


@pytest.fixture
def gateway_of(tmp_path: Path) -> Iterator[Callable[..., Gateway]]:
    made: list[Gateway] = []

    def make(medium: Medium | None, port: int = 0) -> Gateway:
        made.append(Gateway(medium, tmp_path, port))
        return made[-1]

    yield make
    for gateway in made:
        gateway.close()


@pytest.fixture
def tunnel_to() -> Iterator[Callable[[int], Tunnel]]:
    made: list[Tunnel] = []

    def make(port: int) -> Tunnel:
        made.append(Tunnel(port))
        return made[-1]

    yield make
    for tunnel in made:
        tunnel.close()


@pytest.fixture
def visit(browser: Browser, gateway_of: Callable[..., Gateway]) -> Iterator[Callable[..., Tab]]:
    """Opens the page of a match in a window of its own; what it complained of fails the test."""
    made: list[Tab] = []
    served: dict[int, str] = {}

    def open_tab(place: Any, role: str = "spectator", width: int = 1360, height: int = 900, **words: Any) -> Tab:
        origin = place if isinstance(place, str) else served.get(id(place.medium))
        if origin is None:
            origin = served[id(place.medium)] = gateway_of(place.medium).origin
        context = browser.new_context(viewport={"width": width, "height": height}, **words)
        made.append(Tab(context, origin, role))
        return made[-1]

    yield open_tab
    faults = [fault for tab in made for fault in tab.faults]
    for tab in made:
        tab.context.close()
    assert faults == []


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording of 12 s of play, as fast as they can be played."""
    path = tmp_path_factory.mktemp("recorded") / "match.mcap"
    match = Match(pace="lockstep", duration=12.0)
    clock = WallClock()
    loss_counts = LossCounts()
    bus = match.medium.open_bus("friendly", clock)
    recorder = Recorder(
        bus, open_sink(path, clock, "friendly", loss_counts, ONE_FILE), loss_counts, config=match.config
    )
    recording = threading.Thread(target=recorder.run, args=(lambda: False,))
    recording.start()
    match.wait_for_end()
    match.close()
    recording.join(SOON)
    return path


class Replayed:
    """A recording that is replayed on a medium of its own."""

    def __init__(self, path: Path, start: str | None = "1") -> None:
        """A replay that is paused at `start`, where the first frame has been shown."""
        self.medium = Medium()
        self.programme = Replay(ReplaySettings(path, start=start, paused=True, stay=True))
        clock = WallClock()
        self._bus = self.medium.open_bus("friendly", clock)
        setup = self.programme.recording.manifest.setup
        self.host = ReplayHost(self._bus, setup, lambda **ears: self.programme.player(clock, **ears))
        if start is not None:
            self.host.player.control(ReplayRequest(operation=ReplayOperation.STEP))
        self._thread = threading.Thread(target=self.host.run)
        self._thread.start()

    def close(self) -> None:
        self.host.player.ended = True
        self._thread.join(SOON)
        self._bus.close()


@pytest.fixture
def replay_of(recorded: Path) -> Iterator[Callable[..., Replayed]]:
    made: list[Replayed] = []

    def make(**words: Any) -> Replayed:
        made.append(Replayed(recorded, **words))
        return made[-1]

    yield make
    for replay in made:
        replay.close()


@pytest.fixture
def replayed(replay_of: Callable[..., Replayed]) -> Replayed:
    return replay_of()
