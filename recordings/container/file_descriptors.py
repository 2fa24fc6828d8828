"""The schema of a channel of protobuf messages: with it a reader needs nothing but the file."""

from google.protobuf.descriptor import Descriptor, FileDescriptor
from google.protobuf.descriptor_pb2 import FileDescriptorProto, FileDescriptorSet


def file_descriptor_set(message: Descriptor) -> bytes:
    """The `FileDescriptorSet` of a message: its file, after all files that it imports."""
    files: dict[str, FileDescriptorProto] = {}
    _collect(message.file, files)
    return FileDescriptorSet(file=files.values()).SerializeToString()


def _collect(file: FileDescriptor, files: dict[str, FileDescriptorProto]) -> None:
    for imported in file.dependencies:
        _collect(imported, files)
    if file.name not in files:
        files[file.name] = FileDescriptorProto()
        file.CopyToProto(files[file.name])
