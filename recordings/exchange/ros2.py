"""Recording → ROS 2 bag: MCAP with CDR messages and QoS metadata, to be played with `ros2 bag play`.

The output is a rosbag2 folder: the bag and its `metadata.yaml`. Bag time is simulated time. The export requires
rosbags, which is imported only for an export.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from recordings.editing.atomic_output import ExportSummary, atomic_output
from recordings.reading.recording import Recording
from runtime.process.installed import need
from runtime.ros2.match_messages import MatchMessages
from runtime.ros2.message_types import typestore
from runtime.ros2.topic_type import TopicType
from schemas.side import Side
from schemas.topics import BELIEF, COMMAND, EVENT, STATE, WORLD

_TOPICS = (WORLD, COMMAND, BELIEF, STATE, EVENT)


def export(recording: Recording, out: Path) -> ExportSummary:
    """Write the topics of docs/recordings.md: truth, commands, beliefs, events and the state of the game.

    Raises:
        TouchlineError: rosbags is missing, `out` already exists or cannot be written, or the recording is damaged.
    """
    need("--format ros2 requires rosbags, which is not installed", "ros2", "rosbags")
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

    with atomic_output(out) as folder:
        writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
        writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        with writer:
            setup = recording.manifest.setup
            goals = setup is None or setup.free is None
            bag = _Bag(writer)
            messages = MatchMessages(bag.write, recording.lineup().sides, list(Side) if goals else [])
            for recorded, message in recording.decoded(*(topic.fill() for topic in _TOPICS)):
                messages.write(recorded.log_ns, recorded.key, message, recorded.payload)
    return ExportSummary.of(recording, out, bag.written, *_TOPICS)


class _Bag:
    """Writes messages to a bag, on a connection for each topic."""

    def __init__(self, writer: Any) -> None:
        self._writer = writer
        self._connections: dict[str, Any] = {}
        self.written: dict[str, int] = {}
        """Topic → messages."""

    def write(self, topic: str, topic_type: TopicType, log_ns: int, encode: Callable[[], memoryview]) -> None:
        """Write one message."""
        connection = self._connections.get(topic)
        if connection is None:
            connection = self._connections[topic] = self._writer.add_connection(
                topic, topic_type.message, typestore=typestore(), offered_qos_profiles=[_qos(topic_type)]
            )
            self.written[topic] = 0
        self._writer.write(connection, log_ns, encode())
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
