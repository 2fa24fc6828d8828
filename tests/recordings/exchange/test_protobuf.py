"""The file is read with the stock readers alone: mcap, and protobuf by the descriptors that stand in the file."""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.json_format import ParseDict
from google.protobuf.unknown_fields import UnknownFieldSet
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

from message_examples import examples
from recordings.container.file_descriptors import file_descriptor_set
from recordings.container.json_schema import whole_schema
from recordings.exchange.protobuf.export import export
from recordings.exchange.protobuf.message_type import message_type
from recordings.exchange.protobuf.proto_text import proto_text
from recordings.reading.recording import Recording
from schemas.messages.record_batch import RecordBatch
from schemas.topics import TOPICS, WORLD
from schemas.wire.message import Message

MODELS = list(dict.fromkeys(topic.message for topic in TOPICS.values() if topic.message not in (None, RecordBatch)))
"""All messages but batches, which hold others as they are and stand in no recording."""


@pytest.fixture(scope="module")
def file(real: Recording, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export(real, tmp_path_factory.mktemp("typed") / "short.mcap").out


def plain(value: Any) -> Any:
    """A value of protobuf's as JSON has it; fields that are not set are left out."""
    if not hasattr(value, "DESCRIPTOR"):
        return value
    if value.DESCRIPTOR.full_name == "google.protobuf.Value":
        kind = value.WhichOneof("kind")
        return [plain(one) for one in value.list_value.values] if kind == "list_value" else getattr(value, kind)
    fields: dict[str, Any] = {}
    for field in value.DESCRIPTOR.fields:
        content = getattr(value, field.name)
        if field.has_presence and not value.HasField(field.name):
            fields[field.name] = None
        elif hasattr(content, "items"):
            fields[field.name] = {key: plain(one) for key, one in content.items()}
        elif hasattr(content, "append"):
            fields[field.name] = [plain(one) for one in content]
        else:
            fields[field.name] = plain(content)
    return fields


def whole(value: Any, schema: dict[str, Any], definitions: dict[str, Any]) -> Any:
    """A value of JSON's with nothing for what may be nothing, and is an empty list or mapping in protobuf."""
    choices = [choice for choice in schema.get("anyOf", [schema]) if choice.get("type") != "null"]
    one = definitions[choices[0]["$ref"].removeprefix("#/$defs/")] if "$ref" in choices[0] else choices[0]
    if len(choices) > 1:
        return value
    if one.get("type") == "array":
        return [whole(item, one["items"], definitions) for item in value or []]
    if "properties" in one:
        return (
            None
            if value is None
            else {name: whole(value.get(name), below, definitions) for name, below in one["properties"].items()}
        )
    if one.get("type") == "object":
        below = next(iter(one.get("patternProperties", {}).values()), one.get("additionalProperties"))
        return {key: whole(item, below, definitions) for key, item in (value or {}).items()}
    return value


def as_json(message: Message) -> Any:
    schema = whole_schema(type(message))
    return whole(message.plain(), schema, schema.get("$defs", {}))


def stock_class(model: type[Message]) -> Any:
    """The class that a reader makes of what stands in the file."""
    files = descriptor_pb2.FileDescriptorSet.FromString(file_descriptor_set(message_type(model)))
    pool = descriptor_pool.DescriptorPool()
    for one in files.file:
        pool.Add(one)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(f"touchline.{model.__name__}"))


def encode(model: type[Message], values: dict[str, Any]) -> bytes:
    return ParseDict(values, message_factory.GetMessageClass(message_type(model))()).SerializeToString()


def test_every_message_of_a_match_is_decoded_to_the_last_bit_by_the_stock_reader(real: Recording, file: Path) -> None:
    def stock() -> Iterator[tuple[str, int, int, int, Any]]:
        with file.open("rb") as opened:
            reader = make_reader(opened, decoder_factories=[DecoderFactory()], validate_crcs=True)
            for _, channel, message, decoded in reader.iter_decoded_messages(log_time_order=False):
                head = (channel.topic, message.log_time, message.publish_time, message.sequence)
                yield (*head, plain(decoded))

    count = 0
    for (recorded, message), read in zip(real.decoded(), stock(), strict=True):
        head = (recorded.key, recorded.log_ns, recorded.sent_ns, recorded.sequence)
        assert read == (*head, as_json(message))
        count += 1
    assert count > 1000


def test_the_channels_are_typed_and_the_types_attached(file: Path) -> None:
    with file.open("rb") as opened:
        reader = make_reader(opened)
        summary = reader.get_summary()
        assert summary is not None
        texts = {attachment.name: attachment.data.decode() for attachment in reader.iter_attachments()}
        origin = {record.name: record.metadata for record in reader.iter_metadata()}["exported_from"]
    assert {(schema.name, schema.encoding) for schema in summary.schemas.values()} == {
        (f"touchline.{name}", "protobuf") for name in ("World", "Applied", "GameState", "GameEvent", "Command")
    }
    assert {channel.message_encoding for channel in summary.channels.values()} == {"protobuf"}
    assert "map<string, RobotTruth> robots = 4;" in texts["World.proto"]
    assert origin["match"] == "short"


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.__name__)
def test_every_message_of_the_contract_has_a_class_that_keeps_its_example(model: type[Message]) -> None:
    example = examples()[model]
    decoded = stock_class(model).FromString(encode(model, example.plain()))
    assert plain(decoded) == as_json(example)
    assert len(UnknownFieldSet(decoded)) == 0


@pytest.mark.parametrize("number", [0, 1, -1, 127, 128, 2**31, -(2**31), 2**63 - 1, -(2**63)])
def test_whole_numbers_of_every_size_come_back(number: int) -> None:
    model = next(model for model in MODELS if model.__name__ == "RecorderProgress")
    payload = encode(model, {"version": "2.0", "tick": number, "messages": 1, "lost": 0})
    assert stock_class(model).FromString(payload).tick == number


def test_none_differs_from_zero() -> None:
    model = next(model for model in MODELS if model.__name__ == "GameEvent")
    stock = stock_class(model)
    zero = stock.FromString(encode(model, {"measured": 0.0}))
    none = stock.FromString(encode(model, {"measured": None}))
    assert (zero.HasField("measured"), none.HasField("measured")) == (True, False)


def test_the_lines_of_the_documents_read_it_in_a_python_that_knows_nothing_of_this_project(
    real: Recording, file: Path
) -> None:
    document = (Path(__file__).parents[3] / "docs" / "recordings.md").read_text("utf-8")
    pieces = re.findall(r"^```python\n(.*?)^```$", document, re.DOTALL | re.MULTILINE)
    (program,) = [piece for piece in pieces if "mcap_protobuf" in piece]
    program = program.replace("match-protobuf.mcap", file.name) + "import sys\nprint('schemas' in sys.modules)\n"
    run = subprocess.run(
        [sys.executable, "-c", program],
        cwd=file.parent,
        env={"PATH": ""},
        check=True,
        capture_output=True,
        text=True,
        timeout=60,
    )
    *rows, imported = run.stdout.splitlines()
    worlds = [world for _, world in real.decoded(WORLD.key)]
    assert imported == "False" and len(rows) == len(worlds)
    assert [float(one) for one in rows[-1].split()[1:]] == [worlds[-1].ball.x, worlds[-1].robots["cyan1"].heading]


def test_the_proto_text_is_written_for_people() -> None:
    model = next(model for model in MODELS if model.__name__ == "Command")
    text = proto_text(message_type(model))
    assert text.startswith('syntax = "proto3";\npackage touchline;\n')
    assert "  optional int64 acknowledges_order = " in text
    assert text.count("{") == text.count("}")
