"""A match in this process, the gateway's server on loopback before it, and real browsers that look at its page."""

import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser

from coach_gateway.web.settings import WebSettings
from recordings.replay.host import ReplayHost
from recordings.replay.replay import Replay, ReplaySettings
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.messages.replay import ReplayOperation, ReplayRequest
from support.in_process_bus import SharedState
from support.page_gateway import SOON, Gateway, tokens_in
from support.page_match import TEAMS, Match
from support.recorded_match import record_match
from support.staged_match import StagedMatch
from support.tab import Tab


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
def staged(gateway_of: Callable[..., Gateway]) -> Iterator[StagedMatch]:
    """A match whose host publishes what the test has it publish."""
    match = StagedMatch(SharedState(), gateway_of)
    yield match
    match.close()


@pytest.fixture
def visit(browser: Browser, gateway_of: Callable[..., Gateway]) -> Iterator[Callable[..., Tab]]:
    """Opens the page of a match in a window of its own; what it complained of fails the test."""
    made: list[Tab] = []
    served: dict[int, str] = {}

    def open_tab(place: Any, role: str = "spectator", width: int = 1360, height: int = 900, **words: Any) -> Tab:
        shown = {"shown": words.pop("shown")} if "shown" in words else {}
        origin = place if isinstance(place, str) else served.get(id(place.medium))
        if origin is None:
            origin = served[id(place.medium)] = gateway_of(place.medium).origin
        context = browser.new_context(viewport={"width": width, "height": height}, **words)
        made.append(Tab(context, origin, role, **shown))
        return made[-1]

    yield open_tab
    faults = [fault for tab in made for fault in tab.faults]
    for tab in made:
        tab.context.close()
    assert faults == []


@pytest.fixture(scope="module")
def watched(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Match, Tab]]:
    """A match before its kick-off and the referee's page of it, for tests that change neither."""
    match = Match(referee={"mode": "manual"})
    match.signal_kick_off()
    gateway = Gateway(match.medium, WebSettings(port=0), tokens_in(tmp_path_factory.mktemp("watched")))
    tab = Tab(browser.new_context(viewport={"width": 1360, "height": 900}), gateway.origin, "referee")
    yield match, tab
    tab.context.close()
    gateway.close()
    match.close()
    assert tab.faults == []


@pytest.fixture(scope="session")
def record(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """Records a match, as fast as it can be played; the words are those of the match file."""

    def recorded_match(**words: Any) -> Path:
        path = tmp_path_factory.mktemp("recorded") / "match.mcap"
        record_match(path, MatchConfig.model_validate({"seed": 7, "teams": TEAMS, **words}), until=600.0)
        return path

    return recorded_match


@pytest.fixture(scope="session")
def recorded(record: Callable[..., Path]) -> Path:
    """A recording of 12 s of play."""
    return record(duration=12.0)


class Replayed:
    """A recording that is replayed on a medium of its own."""

    def __init__(self, path: Path, start: str | None = "1") -> None:
        """A replay that is paused at `start`, where the first frame has been shown."""
        self.medium = SharedState()
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
def replay_file() -> Iterator[Callable[..., Replayed]]:
    """Replays a file."""
    made: list[Replayed] = []

    def make(path: Path, **words: Any) -> Replayed:
        made.append(Replayed(path, **words))
        return made[-1]

    yield make
    for replay in made:
        replay.close()


@pytest.fixture
def replayed(recorded: Path, replay_file: Callable[..., Replayed]) -> Replayed:
    return replay_file(recorded)
