"""The gateway's services beside a host in one event loop: a fake host, or a real one that is stepped."""

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any

from coach_gateway.match.live import LiveMatch
from robot_agent.process.runner import Runner
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig, load_match
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.radio import Radio
from schemas.messages.sight import Sight
from schemas.side import Side
from sim_host.server.host import Host
from sim_host.server.pace import Lockstep
from sim_host.soccer.referee.game.referee_state import RefereeState
from support.answers import answer_next
from support.fake_host import MATCH, FakeHost
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock

LIMIT_S = 90.0
"""Patience in s, longer than any wait on a busy machine: a test fails only if something never happens."""


async def until(condition: Callable[[], Any], what: str = "") -> None:
    """Wait for a condition."""
    deadline = asyncio.get_running_loop().time() + LIMIT_S
    while not condition():
        assert asyncio.get_running_loop().time() < deadline, f"never came: {what or condition}"
        await asyncio.sleep(0.005)


class Attentive:
    """A brain that stands still, acknowledges orders, and sends its pose."""

    def __init__(self) -> None:
        self.orders: list[CoachOrder] = []
        """All received orders, in order."""

    def act(self, sight: Sight) -> Command:
        if sight.order is not None and (not self.orders or self.orders[-1] != sight.order):
            self.orders.append(sight.order)
        known = self.orders[-1].sequence if self.orders else None
        return Command(answers_tick=sight.tick, radio=Radio(self=sight.self), acknowledges_order=known)


class Pitch:
    """A real host with a robot agent on every robot, stepped as fast as possible."""

    def __init__(self, medium: SharedState, config: MatchConfig) -> None:
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
            answer_next(runner)

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
    """The host: a `FakeHost` or a `Pitch`."""
    live: LiveMatch
    stop: asyncio.Event = field(default_factory=asyncio.Event)
    tasks: list[asyncio.Task[None]] = field(default_factory=list)
    logged: list[str] = field(default_factory=list)
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
    medium = SharedState()
    sizes = {f"teams.{side}.size": 3 for side in Side}
    stage = FakeHost(medium, load_match(None, {**sizes, **teams}))
    async with _beside(stage, medium) as bench:
        stage.say()
        await until(lambda: bench.live.state is not None, "the state")
        yield bench


@asynccontextmanager
async def kicked_off(**words: Any) -> AsyncIterator[Bench]:
    """The same with a real host, and two robots against one; the arguments are overrides of the match file."""
    medium = SharedState()
    sizes = {"teams.cyan.size": 2, "teams.magenta.size": 1}
    pitch = Pitch(medium, load_match(None, {**sizes, "pace": "lockstep", "record.wait": False, **words}))
    async with _beside(pitch, medium) as bench:
        await until(lambda: bench.live.state is not None, "the match")
        yield bench


@asynccontextmanager
async def _beside(stage: Any, medium: SharedState) -> AsyncIterator[Bench]:
    bench = Bench(stage, LiveMatch(medium.open_bus(MATCH, WallClock())))
    bench.start(bench.live)
    bench.start(stage)
    try:
        await until(lambda: bench.live.setup is not None, "the setup")
        yield bench
    finally:
        await bench.end()
        await asyncio.sleep(0)  # transports that were closed are gone only now
