"""A match for bridges on the in-process bus: with a scripted host, or with a real one that is stepped."""

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any

import pytest

from coach_gateway.match.live import LiveMatch
from robot_agent.runner import Runner
from schemas.bus.contract import Bus
from schemas.bus.in_process_bus import Medium
from schemas.config.match_config import MatchConfig, load_match
from schemas.config.profile import load_profile
from schemas.config.rule_book import load_rule_book
from schemas.game import EventKind, Phase
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.game import ActionReply, GameEvent, GameState, RefereeAction
from schemas.messages.radio import Belief, Radio
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.process.clock import SteppedClock, WallClock
from schemas.side import Side
from schemas.topics import ACTION, BELIEF, EVENT, ORDER, SETUP, STATE, WORLD
from sim_host.referee.game.referee_state import RefereeState
from sim_host.server.host import Host
from sim_host.server.pace import Lockstep

LIMIT_S = 90.0
"""Only what never comes fails: a match that is stepped beside the bridges may take long on a busy machine."""
MATCH = "friendly"


async def until(condition: Callable[[], Any], what: str = "") -> None:
    """Wait for a condition."""
    deadline = asyncio.get_running_loop().time() + LIMIT_S
    while not condition():
        assert asyncio.get_running_loop().time() < deadline, f"never came: {what or condition}"
        await asyncio.sleep(0.005)


class Stage:
    """A scripted host: publishes what the test wants, replies with the setup, and records requests."""

    def __init__(self, medium: Medium, config: MatchConfig) -> None:
        self.medium = medium
        self.config = config
        self.bus: Bus = medium.open_bus(MATCH, WallClock())
        self._setups, self._actions = self.bus.serve(SETUP), self.bus.serve(ACTION)
        self._states, self._events = self.bus.publisher(STATE), self.bus.publisher(EVENT)
        self._worlds = self.bus.publisher(WORLD)
        self._orders = self.bus.subscribe(ORDER)
        self.setup = Setup.of(config, load_profile("msl"), load_rule_book("friendly"))
        self.state = GameState(tick=0, time=0.0, phase=Phase.PRE_GAME)
        self.asked: list[RefereeAction] = []
        self.orders: list[tuple[Side, CoachOrder]] = []
        self.answer: Callable[[RefereeAction], ActionReply] = lambda _action: ActionReply(accepted=True)
        self.bus.declare_alive("host", "host")

    def say(self, **changes: Any) -> None:
        """The game goes on to another state."""
        tick = self.state.tick + 1
        self.state = self.state.model_copy(update={"tick": tick, "time": tick * 0.02, **changes})
        self._states.put(self.state)

    def tell(self, text: str) -> None:
        """Something happens."""
        moment = {"tick": self.state.tick, "time": self.state.time, "clock": 0.0}
        self._events.put(GameEvent(**moment, kind=EventKind.ACTION, rule="test", text=text))

    def show(self, **changes: Any) -> World:
        """A tick of the world: every robot on a spot of its own, facing its opponents' goal."""
        robots = {
            name: RobotTruth(
                x=-side.attack(1) * (1.0 + number),
                y=0.5 * number,
                z=0.4,
                heading=0.0 if side is Side.CYAN else 3.0,
                vx=1.0,
                vy=0.0,
                omega=0.5,
                holding=name == "cyan2",
            )
            for side in Side
            for number, name in enumerate(self.config.robots(side))
        }
        ball = BallTruth(x=2.0, y=-1.0, z=0.11, vx=3.0, vy=0.0, vz=0.0)
        content = {"tick": self.state.tick, "time": self.state.time, "robots": robots, "ball": ball}
        world = World(**{**content, **changes})
        self._worlds.put(world)
        return world

    def believe(self, robot: str, radio: Radio) -> None:
        """Publish a robot's belief."""
        side = next(side for side in Side if robot in self.config.robots(side))
        word = Belief(tick=self.state.tick, time=self.state.time, robot=robot, radio=radio)
        self.bus.publisher(BELIEF, side=side.value, robot=robot).put(word)

    async def serve(self, stop: asyncio.Event) -> None:
        while not stop.is_set():
            while (query := self._setups.receive()) is not None:
                query.reply(self.setup)
            while (query := self._actions.receive()) is not None:
                action = query.message()
                self.asked.append(action)
                query.reply(self.answer(action))
            while (received := self._orders.receive()) is not None:
                self.orders.append((Side(received.chunks["side"]), received.message()))
            await asyncio.sleep(0.002)


class Attentive:
    """A brain that stands still, acknowledges orders, and sends its pose."""

    def __init__(self) -> None:
        self.orders: list[CoachOrder] = []
        """All that it was given, in order."""

    def act(self, sight: Sight) -> Command:
        if sight.order is not None and (not self.orders or self.orders[-1] != sight.order):
            self.orders.append(sight.order)
        known = self.orders[-1].sequence if self.orders else None
        return Command(answers_tick=sight.tick, radio=Radio(self=sight.self), acknowledges_order=known)


class Pitch:
    """A real host with a robot agent on every robot, stepped as fast as it goes."""

    def __init__(self, medium: Medium, config: MatchConfig) -> None:
        clock = SteppedClock()
        self.host = Host(config, medium.open_bus(MATCH, clock))
        self.brains = {name: Attentive() for side in Side for name in config.robots(side)}
        self._runners = []
        for name, brain in self.brains.items():
            bus = medium.open_bus(MATCH, SteppedClock())
            self._runners.append(Runner(bus, brain, name))
            bus.declare_alive("agent", name)
        assert isinstance(self.host.pace, Lockstep)
        self.host.pace.step_agents = lambda: (self._answer(), clock.sleep_until(clock.now() + 0.001))

    @property
    def state(self) -> RefereeState:
        return self.host.simulation.state

    def _answer(self) -> None:
        for runner in self._runners:
            runner.answer_next(0.0)

    async def serve(self, stop: asyncio.Event) -> None:
        self.host.wait_for_all()
        self.host.begin()
        while not (stop.is_set() or self.host.simulation.over):
            self.host.tick()
            await asyncio.sleep(0.002)
        self.host.simulation.close()


@dataclass
class Bench:
    """Services beside a host, all in one event loop."""

    stage: Any
    """The host: a `Stage` or a `Pitch`."""
    live: LiveMatch
    stop: asyncio.Event = field(default_factory=asyncio.Event)
    tasks: list[asyncio.Task[None]] = field(default_factory=list)
    said: list[str] = field(default_factory=list)
    """Lines that services logged."""

    def start(self, service: Any) -> asyncio.Task[None]:
        self.tasks.append(asyncio.create_task(service.serve(self.stop)))
        return self.tasks[-1]

    async def end(self) -> None:
        self.stop.set()
        await asyncio.gather(*self.tasks)


@asynccontextmanager
async def opened(**teams: Any) -> AsyncIterator[Bench]:
    """A bench whose gateway knows the match; the arguments are overrides of the match file."""
    medium = Medium()
    sizes = {f"teams.{side}.size": 3 for side in Side}
    stage = Stage(medium, load_match(None, {**sizes, **teams}))
    bench = Bench(stage, LiveMatch(medium.open_bus(MATCH, WallClock())))
    bench.start(stage)
    bench.start(bench.live)
    try:
        await until(lambda: bench.live.setup is not None, "the setup")
        stage.say()
        await until(lambda: bench.live.state is not None, "the state")
        yield bench
    finally:
        await bench.end()
        await asyncio.sleep(0)  # transports that were closed are gone only now


@asynccontextmanager
async def kicked_off(**words: Any) -> AsyncIterator[Bench]:
    """The same with a real host, and two robots against one; the arguments are overrides of the match file."""
    medium = Medium()
    sizes = {"teams.cyan.size": 2, "teams.magenta.size": 1}
    pitch = Pitch(medium, load_match(None, {**sizes, "pace": "lockstep", "record.wait": False, **words}))
    bench = Bench(pitch, LiveMatch(medium.open_bus(MATCH, WallClock())))
    bench.start(bench.live)
    bench.start(pitch)
    try:
        await until(lambda: bench.live.setup is not None and bench.live.state is not None, "the match")
        yield bench
    finally:
        await bench.end()
        await asyncio.sleep(0)


Opened = Callable[..., Any]


@pytest.fixture(name="opened")
def _opened() -> Opened:
    return opened


@pytest.fixture(name="kicked_off")
def _kicked_off() -> Opened:
    return kicked_off


@pytest.fixture(name="until")
def _until() -> Callable[..., Any]:
    return until
