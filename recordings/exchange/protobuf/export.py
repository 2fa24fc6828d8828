"""Writes a recording as MCAP with protobuf messages and their schemas; keys, times, numbers and order are kept."""

from pathlib import Path

from google.protobuf.json_format import ParseDict
from google.protobuf.message import Message as ProtobufMessage
from google.protobuf.message_factory import GetMessageClass

from recordings.container.environment import library
from recordings.container.file_descriptors import file_descriptor_set
from recordings.container.typed_writer import TypedWriter
from recordings.exchange.atomic_output import ExportSummary, atomic_output
from recordings.exchange.omissions import omitted_messages
from recordings.exchange.protobuf.message_type import message_type
from recordings.exchange.protobuf.proto_text import proto_text
from recordings.reading.recording import Recording
from schemas.topics import TOPICS
from schemas.wire.part import encode

ORIGIN = "exported_from"
"""Name of the metadata record that describes the original recording."""


def export(recording: Recording, out: Path) -> ExportSummary:
    """Write all valid messages; the `.proto` file of each type is attached.

    Raises:
        TouchlineError: `out` already exists or cannot be written, or the recording is damaged inside.
    """
    classes: dict[str, type[ProtobufMessage]] = {}
    written: dict[str, int] = {}
    origin = {
        "file": recording.path.name,
        "match": recording.manifest.match,
        "started": recording.manifest.started,
        "contract": recording.manifest.contract,
        "setup": encode(recording.manifest.setup).decode(),
    }
    with atomic_output(out) as path, TypedWriter(path, library()) as writer:
        writer.metadata(ORIGIN, origin)
        for recorded, message in recording.decoded():
            name = type(message).__name__
            if name not in classes:
                descriptor = message_type(type(message))
                classes[name] = GetMessageClass(descriptor)
                writer.attach(f"{name}.proto", proto_text(descriptor).encode())
                writer.schema(name, descriptor.full_name, "protobuf", file_descriptor_set(descriptor))
            if recorded.key not in written:
                writer.channel(recorded.key, name, "protobuf", {"topic": recorded.topic.key, "message": name})
            payload = ParseDict(message.plain(), classes[name]())
            writer.message(
                recorded.key, payload.SerializeToString(), recorded.log_ns, recorded.sent_ns, recorded.sequence
            )
            written[recorded.key] = written.get(recorded.key, 0) + 1
    return ExportSummary(out, written, dict(recording.unreadable), omitted_messages(recording, *TOPICS.values()))
