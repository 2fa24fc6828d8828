"""Writes a recording as MCAP of protobuf, each channel with its schema; keys, times, numbers and order are kept."""

from pathlib import Path

from pydantic_core import to_json, to_jsonable_python

from recordings.container.environment import library
from recordings.container.typed_writer import TypedWriter
from recordings.exchange.atomic_output import ExportSummary, atomic_output
from recordings.exchange.protobuf.descriptor import PACKAGE, descriptor_set, proto_text
from recordings.exchange.protobuf.encode import encode
from recordings.exchange.protobuf.shape import Shape, shape_of
from recordings.reading.recording import Recording

ORIGIN = "exported_from"
"""The metadata that tells where the messages come from."""


def export(recording: Recording, out: Path) -> ExportSummary:
    """Write every message that can be read, typed; the `.proto` of each type is attached.

    Raises:
        TouchlineError: `out` is there already or cannot be written, or the recording is damaged inside.
    """
    shapes: dict[str, Shape] = {}
    written: dict[str, int] = {}
    origin = {
        "file": recording.path.name,
        "match": recording.manifest.match,
        "started": recording.manifest.started,
        "contract": recording.manifest.contract,
        "setup": to_json(recording.manifest.setup).decode(),
    }
    with atomic_output(out) as path, TypedWriter(path, library()) as writer:
        writer.metadata(ORIGIN, origin)
        for recorded, message in recording.decoded():
            name = type(message).__name__
            if name not in shapes:
                shape = shapes[name] = shape_of(type(message))
                writer.attach(f"{name}.proto", proto_text(shape).encode())
                writer.schema(name, f"{PACKAGE}.{name}", "protobuf", descriptor_set(shape))
            if recorded.key not in written:
                writer.channel(recorded.key, name, "protobuf", {"topic": recorded.topic.key, "message": name})
            payload = encode(shapes[name], to_jsonable_python(message, by_alias=True))
            writer.message(recorded.key, payload, recorded.log_ns, recorded.sent_ns, recorded.sequence)
            written[recorded.key] = written.get(recorded.key, 0) + 1
    return ExportSummary(out, written, dict(recording.unreadable))
