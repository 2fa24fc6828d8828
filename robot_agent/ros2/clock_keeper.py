"""The clock of a graph whose nodes drive robots, and the frames that do not move."""

import threading
from collections.abc import Sequence
from typing import Any

from robot_agent.ros2.sight_messages import SightMessages
from runtime.bus.contract import Bus
from runtime.process.timing import REPLY_S
from runtime.ros2.graph import Graph, GraphPublisher
from runtime.ros2.message_builder import MessageBuilder
from runtime.ros2.topic_type import CLOCK, TF, TF_STATIC
from schemas.side import Side
from schemas.topics import STATE


class ClockKeeper:
    """Publishes `/clock` once a tick, as soon as what all robots perceive in it is published: nodes act on it."""

    def __init__(self, graph: Graph, bus: Bus) -> None:
        self.transforms: GraphPublisher = graph.publisher("/tf", TF)
        self.clock, self._static = graph.publisher("/clock", CLOCK), graph.publisher("/tf_static", TF_STATIC)
        self._graph, self._build = graph, MessageBuilder()
        self._published_at = 0.0
        """When the clock was last published, by wall time in s."""
        self._states = bus.subscribe(STATE, history=True)
        self._robots: dict[str, SightMessages] = {}
        self._sides: dict[str, Side] = {}
        self._cyan_attacks = 1
        self._tick, self._now_ns = -1, 0
        self._missing: set[str] = set()
        """Robots of the tick before that are not seen in this one."""
        self._there: set[str] = set()
        """Robots seen in this tick."""
        self._lock = threading.Lock()

    def follow(self, robots: Sequence[SightMessages]) -> None:
        """The robots whose sights make a tick, as far as nodes drive them and they take part."""
        self._robots = {one.robot: one for one in robots}
        self._there = set(self._robots)

    def begin(self, sides: dict[str, Side]) -> None:
        """Another match begins, whose robots are of these sides."""
        with self._lock:
            self._sides, self._tick = sides, -1
            self._publish_frames()

    def seen(self, robot: str, tick: int, now_ns: int) -> None:
        """What a robot perceives at this tick is published; also again, for a sight that was sent again.

        Then the host waits, and the clock is published again, at most once in `REPLY_S` of wall time, or in spite of
        robots whose sights have not come: no node drives them any more, or somebody has removed them.
        """
        with self._lock:
            if tick < self._tick:
                return
            if tick > self._tick:
                if self._missing:
                    self._publish_clock()  # of a tick whose other sights were lost
                self._tick, self._now_ns, self._missing, self._there = tick, now_ns, self._there, set()
            is_repeated, is_awaited = robot in self._there, robot in self._missing
            self._there.add(robot)
            self._missing.discard(robot)
            if is_repeated:
                if self._graph.clock.now() - self._published_at >= REPLY_S:
                    self._publish_clock()
            elif is_awaited and not self._missing:
                self._publish_clock()

    def _publish_clock(self) -> None:
        self._missing, self._published_at = set(), self._graph.clock.now()
        if self.clock.is_read:
            clock = self._build.make(CLOCK.message, self._build.stamp(self._now_ns))
            self.clock.put(self._build.encode(clock, CLOCK))
        while (received := self._states.receive()) is not None:  # while the nodes compute
            attacks = received.message().cyan_attacks
            if attacks != self._cyan_attacks:
                self._cyan_attacks = attacks
                self._publish_frames()

    def _publish_frames(self) -> None:
        """All frames that do not move, in one message: who comes later gets the newest one."""
        stamp = self._build.stamp(self._now_ns)
        found: list[Any] = []
        for name, robot in self._robots.items():
            attack = self._sides.get(name, Side.CYAN).attack(self._cyan_attacks)
            found += robot.static_transforms(stamp, attack)
        self._static.put(self._build.encode(self._build.make(TF_STATIC.message, found), TF_STATIC))
