"""A host on the in-process bus, with agents, recorders and other clients; time passes in steps."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from robot_agent.loading.brain_loader import load_brain
from robot_agent.process.runner import Runner
from robot_agent.sdk.contract import Brain, Briefing
from runtime.bus.contract import Bus, ReceivedMessage
from schemas.config.match_config import MatchConfig
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Command, Drive
from schemas.messages.health import Health
from schemas.messages.recorder import RecorderProgress
from schemas.messages.sight import Sight
from schemas.side import Side
from schemas.soccer.game import EventKind
from schemas.topic import Topic
from schemas.topics import APPLIED, EVENT, HEALTH, RECORDER_PROGRESS, WORLD
from sim_host.server.host import Host
from sim_host.server.pace import Lockstep
from support.answers import answer_next
from support.lossy_medium import LossyMedium
from support.stepped_clock import SteppedClock

LOOK_S = 0.001
"""Wall time that passes in each poll of a waiting host."""
REPORT_NS = 50_000_000
"""Wall time between two reports of a recorder that has nothing new to report."""
TEAMS = {"cyan": {"name": "Cyan", "robots": ["cyan1", "cyan2"]}, "magenta": {"name": "Magenta", "robots": ["magenta1"]}}
"""Two robots against one; all drive ahead."""


class Forward:
    """Drives ahead in every sight."""

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0))


class _SeatClock(SteppedClock):
    """The clock of another process on the host's machine: it has the same wall time, and its own simulated time."""

    def __init__(self, wall: SteppedClock) -> None:
        super().__init__()
        self._wall = wall

    def now(self) -> float:
        return self._wall.now()

    def unix_ns(self) -> int:
        return self._wall.unix_ns()


@dataclass
class Agent:
    """One robot's agent on a bus of its own."""

    bus: Bus
    runner: Runner
    frozen: bool = False
    thinks_s: float = 0.0
    """Wall time from a sight to its answer, in s."""
    _thought: tuple[float, Sight] | None = None

    def pump(self, now: float) -> None:
        if self.frozen:
            return
        if self.thinks_s == 0.0:
            answer_next(self.runner)
            return
        if self._thought is None and (sight := self.runner.next_sight(0.0)) is not None:
            self._thought = now + self.thinks_s, sight
        if self._thought is not None and now >= self._thought[0]:
            self.runner.answer(self._thought[1])
            self._thought = None


@dataclass
class Listener:
    """Keeps the messages of a topic."""

    receive: Callable[[], ReceivedMessage | None]

    def all(self) -> list[Any]:
        """The messages since the last call."""
        return [received.message() for received in iter(self.receive, None)]


class FakeRecorder:
    """Reads ticks and reports its progress, unless it is suspended."""

    def __init__(self, bus: Bus) -> None:
        self.bus = bus
        self.worlds = bus.subscribe(WORLD)
        self.seen = -1
        self.stands = False
        self._reported, self._next_report_ns = -2, 0
        self._progress = bus.publisher(RECORDER_PROGRESS, name="recorder")
        bus.declare_alive("recorder", "recorder")

    def leave(self) -> None:
        self._progress.put(RecorderProgress(tick=self.seen, messages=0, lost=0, leaving=True))
        self.bus.close()

    def pump(self) -> None:
        while not self.stands and (received := self.worlds.receive()) is not None:
            self.seen = received.message().tick
        if self.seen != self._reported or self.bus.clock.unix_ns() >= self._next_report_ns:
            self._reported, self._next_report_ns = self.seen, self.bus.clock.unix_ns() + REPORT_NS
            self.report()

    def report(self) -> None:
        self._progress.put(RecorderProgress(tick=self.seen, messages=0, lost=0))


@dataclass
class HostRig:
    """A host and its clients; the functions in `idle` are called while the host waits."""

    config: MatchConfig
    medium: LossyMedium = field(default_factory=LossyMedium)
    agents: dict[str, Agent] = field(default_factory=dict)
    idle: list[Callable[[], None]] = field(default_factory=list)
    launch_token: str | None = None
    settings: dict[str, Any] = field(default_factory=lambda: {"recorders": ["recorder"]})
    """Further arguments of the host."""

    def __post_init__(self) -> None:
        self.clock = SteppedClock()
        self.outside = self.seat()
        self._applied, self._events, self._health = self.listen(APPLIED), self.listen(EVENT), self.listen(HEALTH)
        self.host = Host(
            self.config, self.medium.open_bus(self.config.name, self.clock), self.launch_token, **self.settings
        )
        if isinstance(self.host.pace, Lockstep):
            self.host.pace.step_agents = self._wait

    def seat(self) -> Bus:
        return self.medium.open_bus(self.config.name, _SeatClock(self.clock))

    def listen(self, topic: Topic) -> Listener:
        return Listener(self.outside.subscribe(topic).receive)

    def join(self, robot: str, brain: Brain | None = None) -> Agent:
        bus = self.seat()
        agent = self.agents[robot] = Agent(bus, Runner(bus, brain or Forward(), robot))
        bus.declare_alive("agent", robot)
        return agent

    def join_all(self) -> None:
        """All agents join, with the brains of the match file; without one they drive ahead."""
        setup = self.host.simulation.setup()
        for side in Side:
            for robot in self.config.robots(side):
                brain = self.config.team(side).brain
                self.join(robot, load_brain(brain, Briefing.of(robot, setup)) if brain else None)

    def leave(self, robot: str) -> None:
        self.agents.pop(robot).bus.close()

    def record(self) -> FakeRecorder:
        recorder = FakeRecorder(self.seat())
        self.idle.append(recorder.pump)
        return recorder

    def begin(self) -> None:
        self.host.wait_for_all()
        self.host.begin()

    def ticks(self, count: int) -> None:
        for _ in range(count):
            if not isinstance(self.host.pace, Lockstep):
                self._give_turns()
            self.host.tick()

    def read_all(self) -> None:
        """Read, and forget, what the host has published."""
        for listener in (self._applied, self._events, self._health):
            listener.all()

    def inputs(self, robot: str) -> list[AppliedInput]:
        """The inputs of a robot in each tick since the last call."""
        return [message.inputs[robot] for message in self._applied.all() if message.inputs]

    def health(self) -> Health:
        """The health of the host, one tick later."""
        self.pass_time(0.3)
        self.ticks(1)
        health: Health = self._health.all()[-1]
        return health

    def silences(self) -> list[str]:
        """Texts of the events about agents, on silence and on manual control."""
        return [event.text for event in self._events.all() if event.kind is EventKind.AGENT]

    def truth(self, robot: str) -> dict[str, Any]:
        """The pose and the velocity of a robot."""
        truth: dict[str, Any] = self.host.simulation.now.world["robots"][robot]
        return truth

    def pass_time(self, seconds: float) -> None:
        self.clock.sleep_until(self.clock.now() + seconds)

    def _wait(self) -> None:
        self._give_turns()
        self.pass_time(LOOK_S)

    def _give_turns(self) -> None:
        for agent in self.agents.values():
            agent.pump(self.clock.now())
        for other in self.idle:
            other()
