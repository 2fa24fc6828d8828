"""A page's server on a real port of loopback, a host that is a seat beside it, and visitors with real WebSockets."""

import asyncio
import itertools
import json
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from coach_gateway.access.tokens import tokens_of
from coach_gateway.web.binding import bind_page
from coach_gateway.web.server import WebServer
from coach_gateway.web.settings import WebSettings
from schemas.bus.contract import Bus, Subscription
from schemas.bus.in_process_bus import Medium
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.rule_book import load_rule_book
from schemas.game import ActionName, EventKind, Phase
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.messages.game import ActionReply, GameEvent, GameState, RefereeAction
from schemas.messages.health import Health
from schemas.messages.parameters import ParametersReply, ParametersRequest
from schemas.messages.radio import Belief, Radio
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from schemas.messages.scene import SceneReply
from schemas.messages.setup import Setup
from schemas.messages.world import BallTruth, World
from schemas.process.clock import WallClock
from schemas.side import Side
from schemas.topic import Topic
from schemas.topics import (
    ACTION,
    ACTIVE_ORDER,
    BELIEF,
    EVENT,
    HEALTH,
    MANUAL,
    ORDER,
    PARAMETERS,
    REPLAY_CONTROL,
    SCENE,
    SETUP,
    STATE,
    WORLD,
)
from schemas.wire.message import Message

SOON = 20.0
"""s; more than anything takes here, so that only what never comes fails a test."""
TOKENS = {"referee": "the-referee", "cyan": "cyans-coach", "magenta": "magentas-coach"}


def event(tick: int, text: str) -> GameEvent:
    return GameEvent(tick=tick, time=tick * 0.02, clock=0.0, kind=EventKind.STOP, rule="stop", text=text)


def world(tick: int) -> World:
    return World(tick=tick, time=tick * 0.02, robots={}, ball=BallTruth(x=tick, y=0, z=0.11, vx=0, vy=0, vz=0))


class FakeHost:
    """Plays a match of two against two as far as a page sees it; refuses every action but `stop`."""

    def __init__(
        self,
        medium: Medium,
        rules: str = "friendly",
        recorded: list[GameEvent] | None = None,
        slow: threading.Event | None = None,
    ) -> None:
        """With `recorded` it is a replay of these events; with `slow`, parameters are answered once it is set."""
        self.bus: Bus = medium.open_bus("friendly", WallClock())
        self.asked: list[Any] = []
        self._rules = rules
        self._recorded = recorded
        self._slow = slow
        self._writers: dict[tuple[str, str], Any] = {}
        self.hands, self.orders = self.bus.subscribe(MANUAL), self.bus.subscribe(ORDER)
        answers: dict[Topic, Callable[[Any], Message]] = {
            SETUP: lambda _: self.setup(),
            ACTION: self._act,
            PARAMETERS: self._tell_parameters,
            SCENE: lambda _: SceneReply(accepted=True, episode=2),
        }
        if recorded is not None:
            answers[REPLAY_CONTROL] = self._replay
        self._threads = [
            threading.Thread(target=self._serve, args=(self.bus.serve(topic), answer), daemon=True)
            for topic, answer in answers.items()
        ]
        for thread in self._threads:
            thread.start()
        self.bus.declare_alive("host", "host")

    def setup(self) -> Setup:
        match = load_match(None, {f"teams.{side}.size": 2 for side in Side})
        return Setup.of(match, load_profile("msl"), load_rule_book(self._rules))

    def put(self, topic: Topic, message: Message, **chunks: str) -> None:
        key = (topic.key, str(chunks))
        if key not in self._writers:
            self._writers[key] = self.bus.publisher(topic, **chunks)
        self._writers[key].put(message)

    def play(self, tick: int) -> None:
        """Publish game, health, beliefs and the world of one tick; a reader of this world has the beliefs already."""
        at: dict[str, Any] = {"tick": tick, "time": tick * 0.02}
        self.put(STATE, GameState(**at, phase=Phase.PLAY))
        self.put(HEALTH, Health(**at, pace="realtime", real_time_factor=1.0))
        for side in Side:
            robot = f"{side}1"
            self.put(BELIEF, Belief(**at, robot=robot, radio=Radio(role="striker")), side=side.value, robot=robot)
        self.put(WORLD, world(tick))

    def happen(self, tick: int, text: str) -> None:
        self.put(EVENT, event(tick, text))

    def stand(self, side: Side, order: CoachOrder, **acknowledged: bool) -> None:
        self.put(ACTIVE_ORDER, ActiveOrder(tick=1, time=0.02, order=order, acknowledged=acknowledged), side=side.value)

    def die(self) -> None:
        self.bus.close()
        for thread in self._threads:
            thread.join()

    def _serve(self, server: Any, answer: Callable[[Any], Message]) -> None:
        while (query := server.receive(None)) is not None:
            message = query.message()
            self.asked.append(message)
            query.reply(answer(message))

    def _tell_parameters(self, request: ParametersRequest) -> ParametersReply:
        if self._slow is not None:
            self._slow.wait(SOON)
        return ParametersReply(accepted=True)

    def _act(self, action: RefereeAction) -> ActionReply:
        accepted = action.action in (ActionName.STOP, ActionName.REPAIR)
        return ActionReply(accepted=accepted, reason="" if accepted else "play is running")

    def _replay(self, request: ReplayRequest) -> ReplayReply:
        told = (self._recorded or []) if request.operation is ReplayOperation.EVENTS else []
        return ReplayReply(accepted=True, time=1.5, end=9.0, events=told)


class Gateway:
    """The page's server in a thread of its own."""

    def __init__(self, medium: Medium, settings: WebSettings, tokens: Path | None) -> None:
        self.said: list[str] = []
        self.binding = bind_page(settings, tokens_of(tokens), tokens)
        self.origin = self.binding.origin
        self.bus = medium.open_bus("friendly", WallClock())
        self._stop = asyncio.Event()
        self._thread = threading.Thread(
            target=self._run,
        )
        self._ready = threading.Event()
        self._thread.start()
        assert self._ready.wait(SOON)

    def _run(self) -> None:
        async def main() -> None:
            self._loop = asyncio.get_running_loop()
            self.server = WebServer(self.bus, self.binding, self.said.append)
            self._ready.set()
            await self.server.serve(self._stop)

        asyncio.run(main())

    @property
    def port(self) -> int:
        return int(self.origin.rpartition(":")[2])

    def close(self) -> None:
        if not self._thread.is_alive():
            return
        self._loop.call_soon_threadsafe(self._stop.set)
        self._thread.join(SOON)
        assert not self._thread.is_alive()
        self.bus.close()


class Visitor:
    """One open page."""

    def __init__(self, origin: str, token: str = "", claims: str | None = None, **more: Any) -> None:
        """`claims` is the origin that it sends, by default its own."""
        self.token = token
        self._numbers = itertools.count(1)
        opening = connect(
            f"{origin.replace('http', 'ws')}/ws",
            origin=origin if claims is None else claims,  # type: ignore[arg-type]
            open_timeout=SOON,
            max_size=None,
            **more,
        )
        self.socket: ClientConnection = opening.__enter__()

    def hear(self, kind: str = "", **fields: Any) -> dict[str, Any]:
        """The next message, of a kind and with these fields where they are named; others are passed over.

        So are signs of life, which come once a second between all else.
        """
        deadline = time.monotonic() + SOON
        while True:
            message: dict[str, Any] = json.loads(self.socket.recv(max(0.0, deadline - time.monotonic())))
            of_kind = message["kind"] == kind if kind else message["kind"] != "alive"
            if of_kind and all(message[name] == value for name, value in fields.items()):
                return message

    def hear_what_is_played(self) -> dict[str, Any]:
        """The first welcome with a setup: before it, requests are refused."""
        welcome = self.hear("welcome")
        while welcome["setup"] is None:
            welcome = self.hear("welcome")
        return welcome

    def ask(self, deed: str, token: str | None = None, **content: Any) -> dict[str, Any]:
        """What is answered to a query."""
        number = self.say(deed, token, **content)
        return self.hear("reply", id=number)

    def say(self, deed: str, token: str | None = None, **content: Any) -> int:
        """Ask without waiting for the answer; returns the number of the query."""
        number = next(self._numbers)
        self.send({"id": number, "token": self.token if token is None else token, "deed": deed, **content})
        return number

    def send(self, content: Any) -> None:
        self.socket.send(content if isinstance(content, str | bytes) else json.dumps(content))

    def enter(self, role: str) -> dict[str, Any]:
        """Take a role, with its token; returns the welcome."""
        self.token = TOKENS[role]
        assert self.ask("token")["accepted"]
        return self.hear("welcome", role=role)

    def close(self) -> None:
        with suppress(ConnectionClosed):
            self.socket.close()


@pytest.fixture
def medium() -> Medium:
    return Medium()


@pytest.fixture
def tokens(tmp_path: Path) -> Path:
    file = tmp_path / "tokens.json"
    file.touch(0o600)
    file.write_text(json.dumps(TOKENS))
    return file


@pytest.fixture
def host_of(medium: Medium) -> Iterator[Callable[..., FakeHost]]:
    made: list[FakeHost] = []

    def make(**words: Any) -> FakeHost:
        made.append(FakeHost(medium, **words))
        return made[-1]

    yield make
    for host in made:
        host.die()


@pytest.fixture
def host(host_of: Callable[..., FakeHost]) -> FakeHost:
    return host_of()


@pytest.fixture
def gateway_of(medium: Medium, tokens: Path) -> Iterator[Callable[..., Gateway]]:
    made: list[Gateway] = []

    def make(tokens_file: Path | None = tokens, **words: Any) -> Gateway:
        made.append(Gateway(medium, WebSettings(**{"port": 0, **words}), tokens_file))
        return made[-1]

    yield make
    for gateway in made:
        gateway.close()


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


def wait_for(reader: Subscription) -> Any:
    """The next message that a host is sent."""
    received = reader.receive(SOON)
    assert received is not None
    return received.message()
