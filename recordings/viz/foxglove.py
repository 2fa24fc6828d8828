"""The messages of `foxglove.*` on the channels for viewers. Foxglove, Lichtblick and Rerun identify them by name."""

from functools import cache

from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.LaserScan_pb2 import LaserScan
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from google.protobuf.descriptor import FileDescriptor
from google.protobuf.descriptor_pb2 import FileDescriptorProto, FileDescriptorSet
from google.protobuf.timestamp_pb2 import Timestamp

_CLASSES = {kind.DESCRIPTOR.full_name: kind for kind in (FrameTransforms, SceneUpdate, Log, LaserScan)}
FRAME_TRANSFORMS, SCENE_UPDATE, LOG, LASER_SCAN = _CLASSES
"""Names of the messages."""
_NS_PER_S = 1_000_000_000


@cache
def descriptors(message: str) -> bytes:
    """The `FileDescriptorSet` of a message, by its name: with it a reader needs nothing but the file."""
    return file_set(_CLASSES[message].DESCRIPTOR.file)


def file_set(file: FileDescriptor) -> bytes:
    """A file and all that it imports, as a `FileDescriptorSet`."""
    files: dict[str, FileDescriptorProto] = {}
    _collect(file, files)
    return FileDescriptorSet(file=files.values()).SerializeToString()


def set_time(timestamp: Timestamp, ns: int) -> None:
    """Set a timestamp to a time in ns."""
    timestamp.seconds, timestamp.nanos = divmod(ns, _NS_PER_S)


def _collect(file: FileDescriptor, files: dict[str, FileDescriptorProto]) -> None:
    """Add a file after all files that it imports."""
    for imported in file.dependencies:
        _collect(imported, files)
    if file.name not in files:
        files[file.name] = FileDescriptorProto()
        file.CopyToProto(files[file.name])
