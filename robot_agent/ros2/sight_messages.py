"""What one robot perceives, as messages of ROS below `/<robot>`, in the frame `<robot>/odom`: its team frame.

A message that nobody reads is not built.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from runtime.ros2.graph import Graph, GraphPublisher
from runtime.ros2.message_builder import MessageBuilder
from runtime.ros2.topic_type import BALL, DIAGNOSTICS, GAME, OBSTACLES, ODOMETRY, SCAN, TF, TopicType
from schemas.config.sensors.range import RangeFinder, RangeReading
from schemas.config.sensors.table import Sensor
from schemas.frames import MAP, base, to_body
from schemas.messages.sight import Sight

_OK, _WARN = b"\x00", b"\x01"
"""Levels of a diagnostic status."""
_DIAGNOSTICS_S = 1.0
"""Simulated time between two diagnostics."""


class SightMessages:
    """The publishers of one robot."""

    def __init__(self, graph: Graph, robot: str, transforms: GraphPublisher) -> None:
        """`transforms` publishes on `/tf`, for all robots."""
        self.robot = robot
        self._graph, self._build = graph, MessageBuilder()
        self._odometry_frame, self._base = f"{robot}/odom", base(robot)
        self.writers: dict[str, GraphPublisher] = {}
        """Topic below that of the robot → its publisher."""
        self._ranges: dict[str, RangeFinder] = {}
        self._scanned: dict[str, int] = {}
        """Range sensor → time of its newest scan in ns."""
        self._diagnosed = -math.inf
        self._transforms = transforms
        for topic, topic_type in (
            ("odom", ODOMETRY),
            ("ball", BALL),
            ("obstacles", OBSTACLES),
            ("game", GAME),
            ("diagnostics", DIAGNOSTICS),
        ):
            self._writer(topic, topic_type)

    def use_sensors(self, sensors: Mapping[str, Sensor]) -> None:
        """Publish scans of the range finders among these sensors from now on."""
        self._ranges = {name: one for name, one in sensors.items() if isinstance(one, RangeFinder)}
        self._scanned = {}
        for name in self._ranges:
            self._writer(self._scan_topic(name), SCAN)

    def static_transforms(self, stamp: Any, attack: int) -> Iterator[Any]:
        """Where the frames of this robot are that do not move; its side attacks `attack` (+1 or −1) in `map`."""
        turned = 0.0 if attack > 0 else math.pi
        yield self._build.transform(stamp, MAP, self._odometry_frame, 0.0, 0.0, 0.0, turned)
        for name, sensor in self._ranges.items():
            yield self._build.transform(stamp, self._base, f"{self.robot}/{name}", *sensor.mount, 0.0)

    @property
    def is_read(self) -> bool:
        """Whether anybody reads one of the messages."""
        return self._transforms.is_read or any(writer.is_read for writer in self.writers.values())

    def publish(self, sight: Sight, faults: Mapping[str, int]) -> None:
        """Publish what somebody reads; `faults` are the counts of what was wrong with commands."""
        build, now_ns = self._build, round(sight.time * 1e9)
        header = build.header(build.stamp(now_ns), self._odometry_frame)
        if self._transforms.is_read:
            own = sight.self
            moved = build.transform(header.stamp, self._odometry_frame, self._base, own.x, own.y, 0.0, own.heading)
            self._transforms.put(build.encode(build.make(TF.message, [moved]), TF))
        self._put("ball", BALL, lambda: self._ball(sight, now_ns))
        self._put("obstacles", OBSTACLES, lambda: self._obstacles(sight, now_ns))
        self._put("game", GAME, lambda: self._game(sight, header))
        for name in self._ranges:
            self._scan(name, sight, now_ns)
        if sight.time - self._diagnosed >= _DIAGNOSTICS_S or sight.time < self._diagnosed:
            self._diagnosed = sight.time
            self._put("diagnostics", DIAGNOSTICS, lambda: self._diagnostics(sight, header, faults))
        self._put("odom", ODOMETRY, lambda: self._odometry(sight, header))  # last: nodes often act on it

    def _put(self, topic: str, topic_type: TopicType, make: Callable[[], Any]) -> None:
        writer = self.writers[topic]
        if writer.is_read:
            writer.put(self._build.encode(make(), topic_type))

    def _writer(self, topic: str, topic_type: TopicType) -> None:
        if topic not in self.writers:
            self.writers[topic] = self._graph.publisher(f"/{self.robot}/{topic}", topic_type)

    def _scan_topic(self, sensor: str) -> str:
        return "scan" if len(self._ranges) == 1 else f"scan_{sensor}"

    def _pictured(self, now_ns: int, age_s: float) -> Any:
        """The header of what a picture of this age shows."""
        return self._build.header(self._build.stamp(max(0, now_ns - round(age_s * 1e9))), self._odometry_frame)

    def _odometry(self, sight: Sight, header: Any) -> Any:
        build, own = self._build, sight.self
        vx, vy = to_body(own.vx, own.vy, own.heading)
        pose = build.pose(own.x, own.y, 0.0, own.heading)
        return build.odometry(header, self._base, pose, build.twist(vx, vy, 0.0, own.omega))

    def _ball(self, sight: Sight, now_ns: int) -> Any:
        build, ball, carries = self._build, sight.ball, (sight.holding, sight.kicker_ready)
        if ball is None:
            zero = build.point(0.0, 0.0, 0.0), build.vector(0.0, 0.0, 0.0)
            return build.make(BALL.message, self._pictured(now_ns, 0.0), False, False, *carries, *zero)
        z = math.nan if ball.z is None else ball.z
        place, velocity = build.point(ball.x, ball.y, z), build.vector(ball.vx, ball.vy, 0.0)
        return build.make(BALL.message, self._pictured(now_ns, ball.age), True, ball.visible, *carries, place, velocity)

    def _obstacles(self, sight: Sight, now_ns: int) -> Any:
        build = self._build
        found = [build.make("touchline_msgs/msg/Obstacle", one.x, one.y, one.radius) for one in sight.obstacles]
        return build.make(OBSTACLES.message, self._pictured(now_ns, sight.obstacles_age), found)

    def _game(self, sight: Sight, header: Any) -> Any:
        game = sight.game
        spot = (math.nan, math.nan) if game.spot is None else (game.spot.x, game.spot.y)
        left = math.nan if game.left is None else game.left
        timing = game.running, game.half, game.clock, left
        score = game.our_score, game.their_score
        own = game.episode, sight.stuck, sight.outcome.refused
        return self._build.make(GAME.message, header, game.phase.value, game.stage.value, *timing, *score, *spot, *own)

    def _scan(self, name: str, sight: Sight, now_ns: int) -> None:
        """Publish a new reading of a range finder, with the time at which it was taken."""
        reading, sensor, build = sight.sensors.get(name), self._ranges[name], self._build
        if not isinstance(reading, RangeReading):
            return
        taken_ns = max(0, now_ns - round(reading.age * 1e9))
        if self._scanned.get(name) == taken_ns:
            return
        self._scanned[name] = taken_ns
        far = reading.angle_min + (len(reading.distances) - 1) * reading.angle_increment
        angles = reading.angle_min, far, reading.angle_increment
        times = 0.0, 1.0 / sensor.rate
        distances = np.array([math.inf if one is None else one for one in reading.distances], np.float32)

        def make() -> Any:
            header = build.header(build.stamp(taken_ns), f"{self.robot}/{name}")
            limits = sensor.min_distance, sensor.max_distance
            return build.make(SCAN.message, header, *angles, *times, *limits, distances, np.empty(0, np.float32))

        self._put(self._scan_topic(name), SCAN, make)

    def _diagnostics(self, sight: Sight, header: Any, faults: Mapping[str, int]) -> Any:
        values = {name: str(count) for name, count in faults.items()}
        values |= {"kicker": "charged" if sight.kicker_ready else "charging", "stuck": str(sight.stuck).lower()}
        pairs = [self._build.make("diagnostic_msgs/msg/KeyValue", *pair) for pair in values.items()]
        said = "; ".join(f"{name}: {count}" for name, count in faults.items()) or "commands are in order"
        level = _WARN if faults else _OK
        name = f"{self.robot}: commands"
        status = self._build.make("diagnostic_msgs/msg/DiagnosticStatus", level[0], name, said, self.robot, pairs)
        return self._build.make(DIAGNOSTICS.message, header, [status])
