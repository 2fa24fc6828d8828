"""A match on the in-process bus whose messages are all built here, for the recorder to record."""

import math
from dataclasses import dataclass, field
from pathlib import Path

from recordings.reading.recording import Recording, open_recording
from recordings.recorder.part_sink import PartSink
from recordings.recorder.recorder import Recorder
from recordings.recorder.recording_summary import RecordingSummary
from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import Bus, Publisher, ReceivedMessage, Server
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.settings import RecordOptions
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.applied import Applied, AppliedInput
from schemas.messages.command import Command, Drive
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import BallTruth, World
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score
from schemas.topic import Topic
from schemas.topics import APPLIED, COMMAND, EVENT, ORDER, SETUP, STATE, WORLD
from support.in_process_bus import InProcessBus, SharedState
from support.messages import make_robot

ROBOTS = ("cyan1", "cyan2", "magenta1", "magenta2")
TICK = 0.02
ONE_PART = RecordOptions()
"""Options of a recorder that writes everything into one part."""
MOMENT = 5.0
"""Longest wall time of a robot's message to the host, in s; no test depends on the exact time."""


def make_setup(match: str = "friendly") -> Setup:
    teams = {f"teams.{side}": {"name": f"Team {side}", "size": 2} for side in Side}
    return Setup.of(load_match(None, {"name": match, **teams}), load_profile("msl"), load_rule_book("friendly"))


def make_world(tick: int, names: tuple[str, ...] = ROBOTS) -> World:
    time = tick * TICK
    robots = {
        name: make_robot((-1) ** number * (2.0 + number) + math.sin(time + number), 1.5 * number - 2.0, time % 3.0)
        for number, name in enumerate(names)
    }
    ball = BallTruth(x=6 * math.sin(time), y=3 * math.cos(time), z=0.11, vx=0.0, vy=0.0, vz=0.0)
    return World(tick=tick, time=time, robots=robots, ball=ball, clock=time)


class PublisherLog(InProcessBus):
    """The publishers of another bus, kept by their keys."""

    def __init__(self, bus: Bus) -> None:
        super().__init__(bus.match, bus.clock, SharedState())
        self.made: dict[str, Publisher] = {}
        self._bus = bus

    def publisher(self, topic: Topic, **chunks: str) -> Publisher:
        made = self.made[topic.fill(**chunks)] = self._bus.publisher(topic, **chunks)
        return made

    def serve(self, topic: Topic, **chunks: str) -> Server:
        return self._bus.serve(topic, **chunks)


@dataclass
class FakeHost:
    """Publishes the messages of host and robots, tick by tick; simulated time is the host's."""

    bus: Bus
    robots: Bus
    setup: Setup
    writers: dict[str, Publisher] = field(default_factory=dict)
    is_prompt: bool = True
    """It publishes a batch for each tick at once."""
    _arrivals: int = 0

    def __post_init__(self) -> None:
        self.server = self.bus.serve(SETUP)
        self.bus.declare_alive("host", "host")
        self.ears = [self.bus.subscribe(topic) for topic in (COMMAND, ORDER)]
        publishers = PublisherLog(self.bus)
        self.direct = publishers.made
        """Key → publisher whose messages are in no record batch."""
        self.batches = BatchPublisher(publishers)
        for topic in (WORLD, APPLIED, STATE, EVENT):
            self.writers[topic.key] = self.batches.publisher(topic)
        for name in ROBOTS:
            self.writers[COMMAND.fill(robot=name)] = self.robots.publisher(COMMAND, robot=name)

    def lose(self, key: str, count: int) -> None:
        """Send messages of a key that reach no recorder."""
        for _ in range(count):
            self.direct[key].put_payload(b"{}")

    def add_unstamped(self, key: str, payload: bytes) -> None:
        """A message of a program that does not use this library has come."""
        self._arrivals += 1
        self.batches.add_received(ReceivedMessage(COMMAND, key, payload, None, arrived_ns=self._arrivals))

    def answer(self) -> None:
        while (query := self.server.receive()) is not None:
            query.reply(self.setup)
        self.batches.process()

    def play(self, tick: int, guests: tuple[str, ...] = ()) -> None:
        """One tick: world, inputs, and the commands of the robots; `guests` are robots that joined."""
        self.bus.clock.sim_ns = self.robots.clock.sim_ns = round(tick * TICK * 1e9)
        self.writers["world"].put(make_world(tick, (*ROBOTS, *guests)))
        inputs = {name: AppliedInput(drive=Drive(vx=1.0), dribble=False, answers_tick=tick) for name in ROBOTS}
        self.writers["host/applied"].put(Applied(tick=tick, time=tick * TICK, inputs=inputs, chain=f"{tick:016x}"))
        for name in ROBOTS:
            self.writers[f"robot/{name}/command"].put(Command(answers_tick=tick, drive=Drive(vx=1.0)))
        self.relay(tick, len(ROBOTS))

    def relay(self, tick: int, count: int = 0) -> None:
        """Add the messages of others to the batch, at least `count`, and end the tick."""
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
        self.event(tick, "goal by cyan2")

    def event(self, tick: int, text: str) -> None:
        """A goal, in these words."""
        self.writers["game/event"].put(
            GameEvent(tick=tick, time=tick * TICK, clock=tick * TICK, kind=EventKind.GOAL, rule="goal", text=text)
        )


@dataclass
class RecorderRig:
    """A host, a recorder, and the file between them."""

    host: FakeHost
    recorder: Recorder
    recorder_bus: Bus
    sink: PartSink
    path: Path
    played: int = 0
    """The next tick, where a test counts them."""

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
        """The host leaves; the recorder reads the rest."""
        self.host.batches.send()
        self.host.bus.close()
        return self.recorder.run(lambda: False)

    def read(self) -> Recording:
        return open_recording(self.path)
