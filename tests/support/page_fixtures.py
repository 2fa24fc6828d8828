"""A page's server on a port of loopback, a fake host on its bus, and visitors with real WebSockets."""

import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from coach_gateway.web.settings import WebSettings
from schemas.config.match_config import load_match
from schemas.messages.parameters import ParametersReply, ParametersRequest
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from schemas.messages.scene import SceneReply
from schemas.messages.soccer.game import ActionReply, GameEvent, RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName
from schemas.topic import Topic
from schemas.topics import ACTION, PARAMETERS, REPLAY_CONTROL, SCENE
from support.fake_host import Answer, FakeHost
from support.in_process_bus import SharedState
from support.page_gateway import SOON, Gateway, tokens_in
from support.visitor import Visitor


@pytest.fixture
def medium() -> SharedState:
    return SharedState()


@pytest.fixture
def tokens(tmp_path: Path) -> Path:
    return tokens_in(tmp_path)


@pytest.fixture
def host_of(medium: SharedState) -> Iterator[Callable[..., FakeHost]]:
    """Makes hosts of two a side that refuse every action but `stop` and `repair`.

    With `recorded` it is a replay of these events; with `slow` parameters are answered once it is set.
    """
    made: list[FakeHost] = []
    match = load_match(None, {f"teams.{side}.size": 2 for side in Side})

    def make(recorded: list[GameEvent] | None = None, slow: threading.Event | None = None, **options: Any) -> FakeHost:
        def act(action: RefereeAction) -> ActionReply:
            accepted = action.action in (ActionName.STOP, ActionName.REPAIR)
            return ActionReply(accepted=accepted, reason="" if accepted else "play is running")

        def parameters(_: ParametersRequest) -> ParametersReply:
            if slow is not None:
                slow.wait(SOON)
            return ParametersReply(accepted=True)

        def replay(request: ReplayRequest) -> ReplayReply:
            events = recorded if request.operation is ReplayOperation.EVENTS else []
            return ReplayReply(accepted=True, time=1.5, end=9.0, events=events or [])

        answers: dict[Topic, Answer] = {
            ACTION: act,
            PARAMETERS: parameters,
            SCENE: lambda _: SceneReply(accepted=True, episode=2),
        }
        if recorded is not None:
            answers[REPLAY_CONTROL] = replay
        made.append(FakeHost(medium, match, answers, in_threads=True, **options))
        return made[-1]

    yield make
    for host in made:
        host.close()


@pytest.fixture
def host(host_of: Callable[..., FakeHost]) -> FakeHost:
    return host_of()


@pytest.fixture(scope="module")
def ending_gateways() -> Iterator[list[Gateway]]:
    """Servers that were told to end after their test: that takes each 0.15 s, for which no other test waits."""
    ending: list[Gateway] = []
    yield ending
    for gateway in ending:
        gateway.close()


@pytest.fixture
def gateway_of(medium: SharedState, tokens: Path, ending_gateways: list[Gateway]) -> Iterator[Callable[..., Gateway]]:
    """Makes servers of pages; the words are those of their settings."""
    made: list[Gateway] = []

    def make(
        shown: SharedState | None = medium, tokens_file: Path | None = tokens, result: Path | None = None, **words: Any
    ) -> Gateway:
        made.append(Gateway(shown, WebSettings(**{"port": 0, **words}), tokens_file, result))
        return made[-1]

    yield make
    for gateway in made:
        gateway.stop()
    ending_gateways += made


@pytest.fixture
def visit(gateway_of: Callable[..., Gateway], host: FakeHost) -> Iterator[Callable[..., Visitor]]:
    """Opens pages of one server that has met its host."""
    gateway = gateway_of()
    made: list[Visitor] = []

    def open_page(role: str = "spectator", **words: Any) -> Visitor:
        made.append(Visitor(gateway.origin, **words))
        made[-1].hear_what_is_played()
        if role != "spectator":
            made[-1].enter(role)
        return made[-1]

    yield open_page
    for visitor in made:
        visitor.close()
