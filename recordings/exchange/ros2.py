"""Recording → ROS 2 bag: MCAP with CDR messages and QoS metadata, to be played with `ros2 bag play`.

The output is a rosbag2 folder: the bag and its `metadata.yaml`. Frames follow REP 103 and REP 105: `map` is the field
frame, `<robot>/base_link` the body frame. Bag time and stamps are simulated time, which is published on `/clock`. The
export requires rosbags, which is imported only here, and only for an export.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from recordings.exchange.atomic_output import ExportSummary, atomic_output
from recordings.reading.recording import Recording
from schemas.errors import TouchlineError
from schemas.frames import to_body
from schemas.messages.command import Command
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.topics import COMMAND, WORLD

MAP = "map"
BALL = "ball"
_EXACT = np.zeros(36)
"""Covariance of exactly known values."""


class TopicType(NamedTuple):
    """Message type and quality of service of a topic."""

    message: str
    reliable: bool
    depth: int


CLOCK = TopicType("rosgraph_msgs/msg/Clock", False, 1)
TF = TopicType("tf2_msgs/msg/TFMessage", True, 100)
ODOMETRY = TopicType("nav_msgs/msg/Odometry", True, 10)
TWIST = TopicType("geometry_msgs/msg/Twist", True, 10)
"""As offered by the usual publishers of these topics: the clock best effort with depth 1, the others reliable."""


def export(recording: Recording, out: Path) -> ExportSummary:
    """Write `/clock`, `/tf`, `/<robot>/odom` and `/<robot>/cmd_vel` of every robot, and `/ball/odom`.

    `cmd_vel` is the velocity that the robot's program commanded, in its body frame.

    Raises:
        TouchlineError: rosbags is missing, `out` already exists or cannot be written, or the recording is damaged.
    """
    try:
        from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
    except ModuleNotFoundError:
        raise TouchlineError(
            "--to ros2 requires rosbags, which is not installed; pip install 'touchline[ros2]'"
        ) from None

    with atomic_output(out) as folder:
        writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        with writer:
            bag = _Bag(writer)
            for recorded, message in recording.decoded(WORLD.key, COMMAND.fill()):
                if isinstance(message, World):
                    bag.world(recorded.log_ns, message)
                elif isinstance(message, Command):
                    bag.command(recorded.log_ns, recorded.key.split("/")[1], message)
    return ExportSummary(out, bag.written, dict(recording.unreadable))


class _Bag:
    """Writes the messages of a recording to a bag."""

    def __init__(self, writer: Any) -> None:
        from rosbags.typesys import Stores, get_typestore

        self._writer = writer
        self._store = get_typestore(Stores.ROS2_JAZZY)
        self._connections: dict[str, Any] = {}
        self.written: dict[str, int] = {}
        """Topic → messages."""

    def world(self, log_ns: int, world: World) -> None:
        """Write clock, transforms and odometry of one tick."""
        stamp = self._make("builtin_interfaces/msg/Time", *divmod(log_ns, 1_000_000_000))
        self._write("/clock", CLOCK, log_ns, self._make(CLOCK.message, stamp))
        transforms = list(self._transforms(stamp, world))
        self._write("/tf", TF, log_ns, self._make(TF.message, transforms))
        for name, robot in world.robots.items():
            self._write(f"/{name}/odom", ODOMETRY, log_ns, self._odometry(stamp, name, robot))
        self._write(f"/{BALL}/odom", ODOMETRY, log_ns, self._ball(stamp, world.ball))

    def command(self, log_ns: int, robot: str, command: Command) -> None:
        """Write the velocities of a command."""
        drive = command.drive
        self._write(f"/{robot}/cmd_vel", TWIST, log_ns, self._twist(drive.vx, drive.vy, 0.0, drive.omega))

    def _transforms(self, stamp: Any, world: World) -> Iterator[Any]:
        for name, robot in world.robots.items():
            yield self._transform(
                stamp, _base(name), self._vector(robot.x, robot.y, robot.z), self._quaternion(robot.heading)
            )
        ball = world.ball
        yield self._transform(stamp, BALL, self._vector(ball.x, ball.y, ball.z), self._quaternion(0.0))

    def _transform(self, stamp: Any, child: str, position: Any, rotation: Any) -> Any:
        transform = self._make("geometry_msgs/msg/Transform", position, rotation)
        return self._make("geometry_msgs/msg/TransformStamped", self._header(stamp), child, transform)

    def _odometry(self, stamp: Any, name: str, robot: RobotTruth) -> Any:
        """Pose in `map`, twist in the body frame, as the definition of the message requires."""
        vx, vy = to_body(robot.vx, robot.vy, robot.heading)
        pose = self._make(
            "geometry_msgs/msg/Pose", self._point(robot.x, robot.y, robot.z), self._quaternion(robot.heading)
        )
        return self._odometry_of(stamp, _base(name), pose, self._twist(vx, vy, 0.0, robot.omega))

    def _ball(self, stamp: Any, ball: BallTruth) -> Any:
        pose = self._make("geometry_msgs/msg/Pose", self._point(ball.x, ball.y, ball.z), self._quaternion(0.0))
        return self._odometry_of(stamp, BALL, pose, self._twist(ball.vx, ball.vy, ball.vz, 0.0))

    def _odometry_of(self, stamp: Any, child: str, pose: Any, twist: Any) -> Any:
        return self._make(
            ODOMETRY.message,
            self._header(stamp),
            child,
            self._make("geometry_msgs/msg/PoseWithCovariance", pose, _EXACT),
            self._make("geometry_msgs/msg/TwistWithCovariance", twist, _EXACT),
        )

    def _twist(self, vx: float, vy: float, vz: float, omega: float) -> Any:
        return self._make(TWIST.message, self._vector(vx, vy, vz), self._vector(0.0, 0.0, omega))

    def _header(self, stamp: Any) -> Any:
        return self._make("std_msgs/msg/Header", stamp, MAP)

    def _vector(self, x: float, y: float, z: float) -> Any:
        return self._make("geometry_msgs/msg/Vector3", x, y, z)

    def _point(self, x: float, y: float, z: float) -> Any:
        return self._make("geometry_msgs/msg/Point", x, y, z)

    def _quaternion(self, heading: float) -> Any:
        return self._make("geometry_msgs/msg/Quaternion", 0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2))

    def _make(self, topic_type: str, *fields: Any) -> Any:
        return self._store.types[topic_type](*fields)

    def _write(self, topic: str, topic_type: TopicType, log_ns: int, message: Any) -> None:
        connection = self._connections.get(topic)
        if connection is None:
            connection = self._connections[topic] = self._writer.add_connection(
                topic, topic_type.message, typestore=self._store, offered_qos_profiles=[_qos(topic_type)]
            )
            self.written[topic] = 0
        self._writer.write(connection, log_ns, self._store.serialize_cdr(message, topic_type.message))
        self.written[topic] += 1


def _base(robot: str) -> str:
    return f"{robot}/base_link"


def _qos(topic_type: TopicType) -> Any:
    """Quality of service as stored by rosbag2 for a topic, without deadlines and leases."""
    from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime

    never = QosTime(2147483647, 4294967295)
    return Qos(
        QosHistory.KEEP_LAST,
        topic_type.depth,
        QosReliability.RELIABLE if topic_type.reliable else QosReliability.BEST_EFFORT,
        QosDurability.VOLATILE,
        never,
        never,
        QosLiveliness.AUTOMATIC,
        never,
        False,
    )
