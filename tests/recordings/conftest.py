"""A match made by hand on the in-process bus, for the recorder to record: every message is built here."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from threading import Event
from typing import Any

import pytest

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.reading.recording import Recording, open_recording
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.record import open_sink
from recordings.recorder.recorder import Recorder, RecordingSummary
from recordings.recorder.sink import ONE_FILE, FileLimits, Sink
from schemas.bus.batch_publisher import BatchPublisher
from schemas.bus.contract import Bus, Publisher
from schemas.bus.in_process_bus import Medium
from schemas.config.match_config import MatchConfig, load_match
from schemas.config.profile import load_profile
from schemas.config.rule_book import load_rule_book
from schemas.game import EventKind, GameEvent, GameState, Phase, Score
from schemas.messages.command import Command, Drive
from schemas.messages.host import Applied, AppliedInput, Setup
from schemas.messages.sight import Sight
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.process.clock import SteppedClock
from schemas.side import Side
from schemas.topics import APPLIED, COMMAND, EVENT, ORDER, SETUP, STATE, WORLD
from sim_host.match.simulation import Simulation
from sim_host.server.outbox import Outbox
from touchline.play import InProcessMatch

ROBOTS = ("cyan1", "cyan2", "magenta1", "magenta2")
TICK = 0.02
MOMENT = 5.0
"""s of wall time that a robot's word may take to the host; nothing depends on how soon it comes."""


def make_setup(match: str = "friendly") -> Setup:
    teams = {f"teams.{side}": {"name": f"Team {side}", "size": 2} for side in Side}
    return Setup.of(load_match(None, {"name": match, **teams}), load_profile("msl"), load_rule_book("friendly"))


def make_world(tick: int) -> World:
    time = tick * TICK
    robots = {
        name: RobotTruth(
            x=(-1) ** number * (2.0 + number) + math.sin(time + number),
            y=1.5 * number - 2.0,
            z=0.4,
            heading=time % 3.0,
            vx=0.0,
            vy=0.0,
            omega=0.0,
            holding=False,
        )
        for number, name in enumerate(ROBOTS)
    }
    ball = BallTruth(x=6 * math.sin(time), y=3 * math.cos(time), z=0.11, vx=0.0, vy=0.0, vz=0.0)
    return World(tick=tick, time=time, robots=robots, ball=ball, clock=time)


@dataclass
class FakeHost:
    """Speaks as host and robots do, tick by tick; simulated time is the host's."""

    bus: Bus
    robots: Bus
    setup: Setup
    writers: dict[str, Publisher] = field(default_factory=dict)
    is_prompt: bool = True
    """It publishes a batch for each tick at once."""

    def __post_init__(self) -> None:
        self.server = self.bus.serve(SETUP)
        self.bus.declare_alive("host", "host")
        self.ears = [self.bus.subscribe(topic) for topic in (COMMAND, ORDER)]
        self.batches = BatchPublisher(self.bus)
        for topic in (WORLD, APPLIED, STATE, EVENT):
            self.writers[topic.key] = self.batches.publisher(topic)
        for name in ROBOTS:
            self.writers[COMMAND.fill(robot=name)] = self.robots.publisher(COMMAND, robot=name)

    def answer(self) -> None:
        while (query := self.server.receive()) is not None:
            query.reply(self.setup)
        self.batches.process()

    def play(self, tick: int) -> None:
        """One tick: truth, the inputs that led to it, the robots' answers to it."""
        self.bus.clock.sim_ns = self.robots.clock.sim_ns = round(tick * TICK * 1e9)
        self.writers["world"].put(make_world(tick))
        inputs = {name: AppliedInput(drive=Drive(vx=1.0), dribble=False, answers_tick=tick) for name in ROBOTS}
        self.writers["host/applied"].put(Applied(tick=tick, time=tick * TICK, inputs=inputs, chain=f"{tick:016x}"))
        for name in ROBOTS:
            self.writers[f"robot/{name}/command"].put(Command(answers_tick=tick, drive=Drive(vx=1.0)))
        self.relay(tick, len(ROBOTS))

    def relay(self, tick: int, count: int = 0) -> None:
        """Note what has come from others, `count` of it at least: all of the tick has been said."""
        came = 0
        for ear in self.ears:
            while (received := ear.receive(MOMENT if came < count else 0.0)) is not None:
                self.batches.add_received(received)
                came += 1
        self.batches.end_tick(tick)
        if self.is_prompt:
            self.batches.send()

    def referee(self, tick: int, phase: Phase, score: Score, side: Side | None = None) -> None:
        self.writers["game/state"].put(
            GameState(tick=tick, time=tick * TICK, phase=phase, side=side, clock=tick * TICK, score=score)
        )
        self.batches.send()

    def goal(self, tick: int) -> None:
        self.writers["game/event"].put(
            GameEvent(
                tick=tick, time=tick * TICK, clock=tick * TICK, kind=EventKind.GOAL, rule="goal", text="goal by cyan2"
            )
        )


@dataclass
class RecorderRig:
    """A host, a recorder, and the file between them."""

    host: FakeHost
    recorder: Recorder
    recorder_bus: Bus
    sink: Sink
    path: Path

    def begin(self) -> None:
        self.recorder.pump()
        self.host.answer()
        self.recorder.pump()

    def play(self, ticks: range, pump_every: int = 3) -> None:
        for tick in ticks:
            self.host.play(tick)
            if tick % pump_every == 0:
                self.recorder.pump()

    def leave(self) -> RecordingSummary:
        """The host leaves; the recorder takes in the rest."""
        self.host.batches.send()
        self.host.bus.close()
        return self.recorder.run(lambda: False)

    def read(self) -> Recording:
        return open_recording(self.path)


RigMaker = Callable[..., RecorderRig]


@pytest.fixture
def make_rig(tmp_path: Path) -> Iterator[RigMaker]:
    rigs: list[RecorderRig] = []

    def make(
        sights: bool = False,
        config: MatchConfig | None = None,
        path: Path | None = None,
        limits: FileLimits = ONE_FILE,
        selection: KeySelection = EVERYTHING,
    ) -> RecorderRig:
        medium = Medium()
        wall = SteppedClock()
        host_bus, robot_bus = medium.open_bus("friendly", SteppedClock()), medium.open_bus("friendly", SteppedClock())
        bus = medium.open_bus("friendly", wall)
        path = path or tmp_path / "match.mcap"
        loss_counts = LossCounts()
        sink = open_sink(path, wall, "friendly", loss_counts, limits)
        host = FakeHost(host_bus, robot_bus, make_setup())
        recorder = Recorder(bus, sink, loss_counts, name="recorder", sights=sights, config=config, selection=selection)
        rigs.append(RecorderRig(host, recorder, bus, sink, path))
        return rigs[-1]

    yield make
    for rig in rigs:
        rig.sink.abandon()


@pytest.fixture
def rig(make_rig: RigMaker) -> RecorderRig:
    """A recorder that knows the host's setup and has begun."""
    rig = make_rig(config=MatchConfig(seed=7))
    rig.begin()
    return rig


@pytest.fixture
def recorded(rig: RecorderRig) -> Recording:
    """A finished recording of 200 ticks with one goal."""
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(100))
    rig.host.goal(100)
    rig.play(range(100, 200))
    rig.host.referee(199, Phase.FULL_TIME, Score(cyan=1))
    rig.leave()
    return rig.read()


@pytest.fixture
def make_fake_host() -> Callable[[Bus, Bus], FakeHost]:
    """Seats a hand-made host on a bus of the test's own."""
    return lambda bus, robots: FakeHost(bus, robots, make_setup())


@pytest.fixture
def wait_until_written() -> Callable[[Any], None]:
    """Waits until what a recorder has handed on is in its file."""

    def wait(rig) -> None:
        done = Event()
        rig.sink.sync()
        rig.sink._writer._hand_over(done.set)
        assert done.wait(30.0)

    return wait


def record_match(
    path: Path,
    config: MatchConfig,
    until: float,
    between: Callable[[Simulation], None] = lambda _: None,
    limits: FileLimits = ONE_FILE,
    viz: bool = True,
) -> None:
    """Play a real match with the teams that ship, in this process and without a network, and record it.

    `between` is called before each tick, for what operators do.
    """
    medium = Medium()
    host_bus, bus = medium.open_bus(config.name, SteppedClock()), medium.open_bus(config.name, SteppedClock())
    table, server = InProcessMatch(config), host_bus.serve(SETUP)
    simulation = table.simulation
    host_bus.declare_alive("host", "host")
    batches = BatchPublisher(host_bus)
    outbox = Outbox(batches, simulation.roster, simulation.profile.time.tick)
    loss_counts = LossCounts()
    recorder = Recorder(
        bus, open_sink(path, bus.clock, config.name, loss_counts, limits, viz=viz), loss_counts, config=config
    )
    ear = host_bus.subscribe(COMMAND)
    commands = {name: host_bus.publisher(COMMAND, robot=name) for name in table.brains}
    recorder.pump()
    while (query := server.receive()) is not None:
        query.reply(simulation.setup())
    tick = simulation.now
    while True:
        host_bus.clock.sim_ns = round(tick.time * 1e9)
        outbox.publish_tick(tick, simulation.state)
        while (received := ear.receive()) is not None:
            batches.add_received(received)
        batches.end_tick(tick.tick)
        if tick.tick % 25 == 0:
            recorder.pump()
        if simulation.over or tick.time >= until:
            break
        between(simulation)
        outbox.set_roster(simulation.roster)
        playing = {name: brain for name, brain in table.brains.items() if name in tick.sights}
        said = {
            name: Command.decode(brain.act(Sight.decode(tick.sights[name])).encode()) for name, brain in playing.items()
        }
        for name, command in said.items():
            commands[name].put(command)
        tick = simulation.step(said)
    batches.send()
    simulation.close()
    host_bus.close()
    recorder.run(lambda: False)


@pytest.fixture(scope="session")
def match_recorder() -> Callable[..., None]:
    """Records any match in this process, as `record_match` says."""
    return record_match


@pytest.fixture(scope="session")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording of the first 24 s of a real match of five a side."""
    path = tmp_path_factory.mktemp("played") / "match.mcap"
    record_match(path, load_match(None, {"seed": 7, "duration": 60.0}), until=24.0)
    return path
