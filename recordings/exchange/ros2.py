"""Recording → ROS 2 bag: MCAP with CDR messages and QoS metadata, to be played with `ros2 bag play`.

The output is a rosbag2 folder: the bag and its `metadata.yaml`. Frames follow REP 103 and REP 105: `map` is the field
frame, `<robot>/base_link` the body frame. Bag time and stamps are simulated time, which is published on `/clock`. The
export requires rosbags, which is imported only here, and only for an export.
"""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from recordings.editing.atomic_output import ExportSummary, atomic_output
from recordings.reading.recording import Recording
from recordings.viz.transforms import BALL, MAP, base, pushed
from schemas.errors import TouchlineError
from schemas.frames import Pose, to_body
from schemas.messages.command import Command
from schemas.messages.radio import Belief
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.side import Side
from schemas.topics import BELIEF, COMMAND, EVENT, STATE, WORLD

_TOPICS = (WORLD, COMMAND, BELIEF, STATE, EVENT)
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
POSE = TopicType("geometry_msgs/msg/PoseStamped", True, 10)
POINT = TopicType("geometry_msgs/msg/PointStamped", True, 10)
NUMBER = TopicType("std_msgs/msg/Int32", True, 10)
VALUE = TopicType("std_msgs/msg/Float64", True, 10)
TEXT = TopicType("std_msgs/msg/String", True, 100)
"""As offered by the usual publishers of these topics: the clock best effort with depth 1, the others reliable."""


def export(recording: Recording, out: Path) -> ExportSummary:
    """Write the topics of docs/recordings.md: truth, commands, beliefs, events and the state of the game.

    `cmd_vel` is the velocity that the robot's program commanded, in its body frame. Beliefs are turned from the team
    frame to the field frame. What no usual ROS message holds is JSON in a `std_msgs/String`, as on the bus.

    Raises:
        TouchlineError: rosbags is missing, `out` already exists or cannot be written, or the recording is damaged.
    """
    try:
        from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
    except ModuleNotFoundError:
        raise TouchlineError(
            "--format ros2 requires rosbags, which is not installed; pip install 'touchline[ros2]'"
        ) from None

    with atomic_output(out) as folder:
        writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        with writer:
            setup = recording.manifest.setup
            goals = setup is None or setup.free is None
            bag = _Bag(writer, recording.lineup().sides, list(Side) if goals else [])
            for recorded, message in recording.decoded(*(topic.fill() for topic in _TOPICS)):
                match message:
                    case World():
                        bag.world(recorded.log_ns, message)
                    case Command():
                        bag.command(recorded.log_ns, recorded.key.split("/")[1], message)
                    case Belief():
                        bag.belief(recorded.log_ns, message, recorded.payload)
                    case GameState():
                        bag.state(recorded.log_ns, message, recorded.payload)
                    case GameEvent():
                        bag.text("/game/event", recorded.log_ns, recorded.payload)
    return ExportSummary.of(recording, out, bag.written, *_TOPICS)


class _Bag:
    """Writes the messages of a recording to a bag."""

    def __init__(self, writer: Any, sides: dict[str, Side], scoring: Sequence[Side]) -> None:
        """`scoring` are the sides that score goals."""
        from rosbags.typesys import Stores, get_typestore

        self._sides, self._scoring = sides, scoring
        self._cyan_attacks = 1
        self._writer = writer
        self._store = get_typestore(Stores.ROS2_JAZZY)
        self._connections: dict[str, Any] = {}
        self.written: dict[str, int] = {}
        """Topic → messages."""

    def world(self, log_ns: int, world: World) -> None:
        """Write clock, transforms and odometry of one tick."""
        stamp = self._stamp(log_ns)
        self._write("/clock", CLOCK, log_ns, self._make(CLOCK.message, stamp))
        transforms = list(self._transforms(stamp, world))
        self._write("/tf", TF, log_ns, self._make(TF.message, transforms))
        for name, robot in world.robots.items():
            self._write(f"/{name}/odom", ODOMETRY, log_ns, self._odometry(stamp, name, robot))
        if world.ball is not None:
            self._write(f"/{BALL}/odom", ODOMETRY, log_ns, self._ball(stamp, world.ball))

    def command(self, log_ns: int, robot: str, command: Command) -> None:
        """Write the velocities of a command."""
        drive = command.drive
        self._write(f"/{robot}/cmd_vel", TWIST, log_ns, self._twist(drive.vx, drive.vy, 0.0, drive.omega))

    def belief(self, log_ns: int, belief: Belief, payload: bytes) -> None:
        """Write a radio message, and where the robot believes itself and the ball to be, in the field frame."""
        robot, radio, header = belief.robot, belief.radio, self._header(self._stamp(log_ns))
        self.text(f"/{robot}/belief", log_ns, payload)
        side = self._sides.get(robot)
        if side is None:
            return
        attack = side.attack(self._cyan_attacks)
        if radio.self is not None:
            own = Pose(radio.self.x, radio.self.y, radio.self.heading).team(attack)
            pose = self._pose(own.x, own.y, 0.0, own.heading)
            self._write(f"/{robot}/belief/pose", POSE, log_ns, self._make(POSE.message, header, pose))
        if radio.ball is not None:
            point = self._point(attack * radio.ball.x, attack * radio.ball.y, 0.0)
            self._write(f"/{robot}/belief/ball", POINT, log_ns, self._make(POINT.message, header, point))

    def state(self, log_ns: int, state: GameState, payload: bytes) -> None:
        """Write the state of the game, and the score as numbers."""
        self._cyan_attacks = state.cyan_attacks
        self.text("/game/state", log_ns, payload)
        if state.value is not None:
            self._write("/game/score", VALUE, log_ns, self._make(VALUE.message, state.value))
        for side in self._scoring:
            goals = self._make(NUMBER.message, getattr(state.score, side.value))
            self._write(f"/game/score/{side.value}", NUMBER, log_ns, goals)

    def text(self, topic: str, log_ns: int, payload: bytes) -> None:
        """Write a message as JSON."""
        self._write(topic, TEXT, log_ns, self._make(TEXT.message, payload.decode()))

    def _stamp(self, log_ns: int) -> Any:
        return self._make("builtin_interfaces/msg/Time", *divmod(log_ns, 1_000_000_000))

    def _transforms(self, stamp: Any, world: World) -> Iterator[Any]:
        for name, robot in world.robots.items():
            yield self._transform(stamp, base(name), robot.x, robot.y, robot.z, robot.heading)
        for name, one in world.obstacles.items():
            if one.pushed is not None:
                yield self._transform(stamp, pushed(name), one.x, one.y, 0.0, one.heading)
        if (ball := world.ball) is not None:
            yield self._transform(stamp, BALL, ball.x, ball.y, ball.z, 0.0)

    def _transform(self, stamp: Any, child: str, x: float, y: float, z: float, heading: float) -> Any:
        rotation = self._quaternion(heading)
        transform = self._make("geometry_msgs/msg/Transform", self._vector(x, y, z), rotation)
        return self._make("geometry_msgs/msg/TransformStamped", self._header(stamp), child, transform)

    def _odometry(self, stamp: Any, name: str, robot: RobotTruth) -> Any:
        """Pose in `map`, twist in the body frame, as the definition of the message requires."""
        vx, vy = to_body(robot.vx, robot.vy, robot.heading)
        pose = self._pose(robot.x, robot.y, robot.z, robot.heading)
        return self._odometry_of(stamp, base(name), pose, self._twist(vx, vy, 0.0, robot.omega))

    def _ball(self, stamp: Any, ball: BallTruth) -> Any:
        pose = self._pose(ball.x, ball.y, ball.z, 0.0)
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

    def _pose(self, x: float, y: float, z: float, heading: float) -> Any:
        return self._make("geometry_msgs/msg/Pose", self._point(x, y, z), self._quaternion(heading))

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
