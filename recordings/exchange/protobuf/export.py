"""Writes a recording as MCAP with protobuf messages and their schemas; keys, times, numbers and order are kept."""

from pathlib import Path

from google.protobuf.json_format import ParseDict
from google.protobuf.message import Message as ProtobufMessage
from google.protobuf.message_factory import GetMessageClass

from recordings.container.environment import library
from recordings.container.file_descriptors import file_descriptor_set
from recordings.container.mcap_writer import mcap_writer
from recordings.editing.atomic_output import ExportSummary, atomic_output
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
    schemas: dict[str, int] = {}
    channels: dict[str, int] = {}
    with atomic_output(out) as path, path.open("wb") as file:
        writer = mcap_writer(file)
        writer.start(profile="", library=library())
        writer.add_metadata(ORIGIN, origin)
        for recorded, message in recording.decoded():
            name = type(message).__name__
            if name not in classes:
                descriptor = message_type(type(message))
                classes[name] = GetMessageClass(descriptor)
                writer.add_attachment(0, 0, f"{name}.proto", "text/plain", proto_text(descriptor).encode())
                content = file_descriptor_set(descriptor)
                schemas[name] = writer.register_schema(descriptor.full_name, "protobuf", content)
            if recorded.key not in written:
                metadata = {"topic": recorded.topic.key, "message": name}
                channels[recorded.key] = writer.register_channel(recorded.key, "protobuf", schemas[name], metadata)
            payload = ParseDict(message.plain(), classes[name]()).SerializeToString()
            numbers = recorded.sent_ns, recorded.sequence
            writer.add_message(channels[recorded.key], recorded.log_ns, payload, *numbers)
            written[recorded.key] = written.get(recorded.key, 0) + 1
        writer.finish()  # type: ignore[no-untyped-call]
    return ExportSummary.of(recording, out, written, *TOPICS.values())
