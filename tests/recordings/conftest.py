"""A match made by hand on the in-process bus, for the recorder to record: every message is built here."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from arena.in_process import Table
from recordings.account import Account
from recordings.output import ONE_FILE, Limits, Output
from recordings.reader import Recording, open_recording
from recordings.record import output_at
from recordings.recorder import Recorder, RecordingSummary
from recordings.selection import EVERYTHING, Selection
from schemas.bus.contract import Bus, Publisher
from schemas.bus.in_process import Medium
from schemas.bus.minutes import MinuteKeeper
from schemas.clock import SteppedClock
from schemas.command import Command, Drive
from schemas.game import EventKind, GameEvent, GameState, Phase, Score
from schemas.host import Applied, AppliedInput, Setup
from schemas.match_config import MatchConfig, load_match
from schemas.profile import load_profile
from schemas.rule_book import load_rule_book
from schemas.side import Side
from schemas.sight import Sight
from schemas.topics import APPLIED, COMMAND, EVENT, ORDER, SETUP, STATE, WORLD
from schemas.world import BallTruth, RobotTruth, World
from sim_host.outbox import Outbox
from sim_host.simulation import Simulation

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
class HandMadeHost:
    """Speaks as host and robots do, tick by tick; simulated time is the host's."""

    bus: Bus
    robots: Bus
    setup: Setup
    writers: dict[str, Publisher] = field(default_factory=dict)
    is_prompt: bool = True
    """It sends the minutes of each tick at once, so that nobody has to wait for them."""

    def __post_init__(self) -> None:
        self.server = self.bus.serve(SETUP)
        self.bus.declare_alive("host", "host")
        self.ears = [self.bus.subscribe(topic) for topic in (COMMAND, ORDER)]
        self.minutes = MinuteKeeper(self.bus)
        for topic in (WORLD, APPLIED, STATE, EVENT):
            self.writers[topic.key] = self.minutes.publisher(topic)
        for name in ROBOTS:
            self.writers[COMMAND.fill(robot=name)] = self.robots.publisher(COMMAND, robot=name)

    def answer(self) -> None:
        while (question := self.server.receive()) is not None:
            question.answer(self.setup)

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
                self.minutes.note(received)
                came += 1
        self.minutes.end_tick(tick)
        if self.is_prompt:
            self.minutes.send()

    def referee(self, tick: int, phase: Phase, score: Score, side: Side | None = None) -> None:
        self.writers["game/state"].put(
            GameState(tick=tick, time=tick * TICK, phase=phase, side=side, clock=tick * TICK, score=score)
        )
        self.minutes.send()

    def goal(self, tick: int) -> None:
        self.writers["game/event"].put(
            GameEvent(
                tick=tick, time=tick * TICK, clock=tick * TICK, kind=EventKind.GOAL, rule="goal", text="goal by cyan2"
            )
        )


@dataclass
class Stage:
    """A host, a recorder, and the file between them."""

    host: HandMadeHost
    recorder: Recorder
    recorder_bus: Bus
    output: Output
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
        self.host.minutes.send()
        self.host.bus.close()
        return self.recorder.run(lambda: False)

    def read(self) -> Recording:
        return open_recording(self.path)


StageMaker = Callable[..., Stage]


@pytest.fixture
def make_stage(tmp_path: Path) -> Iterator[StageMaker]:
    stages: list[Stage] = []

    def make(
        sights: bool = False,
        config: MatchConfig | None = None,
        path: Path | None = None,
        limits: Limits = ONE_FILE,
        selection: Selection = EVERYTHING,
    ) -> Stage:
        medium = Medium()
        wall = SteppedClock()
        host_bus, robot_bus = medium.seat("friendly", SteppedClock()), medium.seat("friendly", SteppedClock())
        bus = medium.seat("friendly", wall)
        path = path or tmp_path / "match.mcap"
        account = Account()
        output = output_at(path, wall, "friendly", account, limits)
        host = HandMadeHost(host_bus, robot_bus, make_setup())
        recorder = Recorder(bus, output, account, name="recorder", sights=sights, config=config, selection=selection)
        stages.append(Stage(host, recorder, bus, output, path))
        return stages[-1]

    yield make
    for stage in stages:
        stage.output.abandon()


@pytest.fixture
def stage(make_stage: StageMaker) -> Stage:
    """A recorder that knows the host's setup and has begun."""
    stage = make_stage(config=MatchConfig(seed=7))
    stage.begin()
    return stage


@pytest.fixture
def recorded(stage: Stage) -> Recording:
    """A finished recording of 200 ticks with one goal."""
    stage.host.referee(0, Phase.PLAY, Score())
    stage.play(range(100))
    stage.host.goal(100)
    stage.play(range(100, 200))
    stage.host.referee(199, Phase.FULL_TIME, Score(cyan=1))
    stage.leave()
    return stage.read()


@pytest.fixture
def hand_made_host() -> Callable[[Bus, Bus], HandMadeHost]:
    """Seats a hand-made host on a bus of the test's own."""
    return lambda bus, robots: HandMadeHost(bus, robots, make_setup())


def record_match(
    path: Path,
    config: MatchConfig,
    until: float,
    between: Callable[[Simulation], None] = lambda _: None,
    limits: Limits = ONE_FILE,
    viz: bool = True,
) -> None:
    """Play a real match with the teams that ship, in this process and without a network, and record it.

    `between` is called before each tick, for what operators do.
    """
    medium = Medium()
    host_bus, bus = medium.seat(config.name, SteppedClock()), medium.seat(config.name, SteppedClock())
    table, server = Table(config), host_bus.serve(SETUP)
    simulation = table.simulation
    host_bus.declare_alive("host", "host")
    minutes = MinuteKeeper(host_bus)
    outbox = Outbox(minutes, simulation.roster, simulation.profile.time.tick)
    account = Account()
    recorder = Recorder(bus, output_at(path, bus.clock, config.name, account, limits, viz=viz), account, config=config)
    ear = host_bus.subscribe(COMMAND)
    commands = {name: host_bus.publisher(COMMAND, robot=name) for name in table.brains}
    recorder.pump()
    while (question := server.receive()) is not None:
        question.answer(simulation.setup())
    tick = simulation.now
    while True:
        host_bus.clock.sim_ns = round(tick.time * 1e9)
        outbox.truth(tick, simulation.state)
        while (received := ear.receive()) is not None:
            minutes.note(received)
        minutes.end_tick(tick.tick)
        if tick.tick % 25 == 0:
            recorder.pump()
        if simulation.over or tick.time >= until:
            break
        between(simulation)
        outbox.follow(simulation.roster)
        playing = {name: brain for name, brain in table.brains.items() if name in tick.sights}
        said = {
            name: Command.decode(brain.act(Sight.decode(tick.sights[name])).encode()) for name, brain in playing.items()
        }
        for name, command in said.items():
            commands[name].put(command)
        tick = simulation.step(said)
    minutes.send()
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
