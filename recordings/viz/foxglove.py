"""The messages of `foxglove.*` on the channels for viewers. Foxglove, Lichtblick and Rerun identify them by name."""

from functools import cache

from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.LaserScan_pb2 import LaserScan
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from google.protobuf.timestamp_pb2 import Timestamp

from recordings.container.file_descriptors import file_descriptor_set

_CLASSES = {kind.DESCRIPTOR.full_name: kind for kind in (FrameTransforms, SceneUpdate, Log, LaserScan)}
FRAME_TRANSFORMS, SCENE_UPDATE, LOG, LASER_SCAN = _CLASSES
"""Names of the messages."""
_NS_PER_S = 1_000_000_000


@cache
def descriptors(message: str) -> bytes:
    """The `FileDescriptorSet` of a message, by its name."""
    return file_descriptor_set(_CLASSES[message].DESCRIPTOR)


def set_time(timestamp: Timestamp, ns: int) -> None:
    """Set a timestamp to a time in ns."""
    timestamp.seconds, timestamp.nanos = divmod(ns, _NS_PER_S)
