"""Recordings to verify, and copies of them with changes."""

from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer
from pydantic_core import from_json

from recordings.container.manifest import Result
from recordings.container.mcap_file import DERIVED
from recordings.container.sealed_metadata import digest, from_metadata, sealed, to_metadata
from recordings.recorder.sequence_tracker import SequenceTracker
from runtime.bus.contract import Stamp
from schemas.config.match_config import load_match
from schemas.config.roster import Placement
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.wire.part import encode
from schemas.wire.part_faults import validated
from sim_host.match.simulation import Simulation
from support.brisk import BRISK
from support.recorded_match import match_recorder

__all__ = ["match_recorder"]

Fields = dict[str, Any]
Edit = Callable[[Fields], Fields | None]
"""What becomes of a message: its fields, or nothing when it is left out."""

POST = {"name": "post", "shape": "cylinder", "place": [2.0, -3.0], "radius": 0.15, "height": 0.9}


def operate(simulation: Simulation) -> None:
    """Three deeds, each of which makes a checkpoint."""
    match simulation.world.tick:
        case 110:
            place = [Placement(body="ball", x=1.0, y=2.0, vx=-1.0, vy=0.5)]
            assert simulation.handle_scene(SceneRequest(operation=SceneOperation.PLACE, place=place)).accepted
        case 170:
            values = {"drive.max_speed": 3.0, "ball.rolling_deceleration": 0.8}
            assert simulation.handle_parameters(
                ParametersRequest(operation=ParameterOperation.SET, values=values)
            ).accepted
        case 230:
            request = validated(SceneRequest, {"operation": "add", "obstacles": [POST]})
            assert simulation.handle_scene(request).accepted


@pytest.fixture(name="operate")
def operate_fixture() -> Callable[[Simulation], None]:
    """What the operator of `operated` does."""
    return operate


@pytest.fixture(scope="session")
def operated(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> Path:
    """A match of two a side: a kick-off, and three deeds of an operator; 260 ticks or so."""
    path = tmp_path_factory.mktemp("operated") / "match.mcap"
    teams = {"teams.cyan.size": 2, "teams.magenta.size": 2}
    config = load_match(None, {"seed": 3, "duration": 10.0, "rules": str(BRISK), **teams})
    match_recorder(path, config, until=5.2, between=operate)
    return path


class Copied(NamedTuple):
    """A message of a recording, with its payload as fields."""

    key: str
    fields: Any
    log_ns: int
    sent_ns: int
    sequence: int


Messages = Callable[[list[Copied]], list[Copied]]
"""The messages of a copy, from those of the original in the order of the file."""
Editor = Callable[..., Path]


def unchanged(_name: str, content: Any) -> Any:
    return content


def rewrite(
    source: Path,
    path: Path,
    messages: Messages,
    metadata: Callable[[str, dict[str, str]], dict[str, str]] = unchanged,
    attachment: Callable[[str, bytes], bytes] = unchanged,
    recount: bool = True,
) -> Path:
    """Copy a recording with other messages, attachments or metadata; every checksum is right again.

    With `recount`, so are the counts in its result.
    """
    with source.open("rb") as file, path.open("wb") as out:
        reader, writer = make_reader(file), Writer(out)
        writer.start(profile="", library="touchline/test")
        copied, originals, channels = [], {}, {}
        for schema, channel, message in reader.iter_messages(log_time_order=False):
            assert schema is not None
            channels.setdefault(channel.topic, (schema, channel))
            if DERIVED in channel.metadata:
                continue
            one = Copied(
                channel.topic, from_json(message.data), message.log_time, message.publish_time, message.sequence
            )
            originals[id(one.fields)] = (message.data, encode(one.fields))
            copied.append(one)
        copied = messages(copied)
        attached = {one.name: (one.media_type, attachment(one.name, one.data)) for one in reader.iter_attachments()}
        trackers: dict[str, SequenceTracker] = defaultdict(SequenceTracker)
        payloads = []
        for one in copied:
            data, before = originals.get(id(one.fields), (b"", b""))
            payloads.append(data if encode(one.fields) == before else encode(one.fields))
            trackers[one.key].add(Stamp(one.sequence, one.sent_ns, one.log_ns), len(payloads[-1]))
        for record in reader.iter_metadata():
            name = record.name.removesuffix("_copy")
            fields = metadata(name, record.metadata)
            if name == "manifest":
                digests = {name: digest(content) for name, (_, content) in attached.items()}
                fields = {**fields, "attached": encode(digests).decode()}
            elif record.name == "result" and recount:
                result = from_metadata(Result, fields)
                counts = {key: tracker.count() for key, tracker in trackers.items()}
                fields = to_metadata(result.counted(counts))
            writer.add_metadata(record.name, sealed(fields))
        for name, (media_type, content) in attached.items():
            writer.add_attachment(0, 0, name, media_type, content)
        numbers: dict[str, int] = {}
        for one, payload in zip(copied, payloads, strict=True):
            if one.key not in numbers:
                schema, channel = channels[one.key]
                number = writer.register_schema(schema.name, schema.encoding, schema.data)
                numbers[one.key] = writer.register_channel(one.key, channel.message_encoding, number, channel.metadata)
            writer.add_message(numbers[one.key], one.log_ns, payload, one.sent_ns, one.sequence)
        writer.finish()
    return path


def of_key(key: str, edit: Edit) -> Messages:
    """Edit each message of a key."""

    def all_of(messages: list[Copied]) -> list[Copied]:
        edited = [one._replace(fields=edit(one.fields)) if one.key == key else one for one in messages]
        return [one for one in edited if one.fields is not None]

    return all_of


@pytest.fixture
def edited(tmp_path: Path) -> Editor:
    """Copies a recording with other messages of one key, attachments or metadata; every checksum is right again."""

    def copy(source: Path, key: str, edit: Edit, metadata: Any = unchanged, **options: Any) -> Path:
        return rewrite(source, tmp_path / "edited.mcap", of_key(key, edit), metadata, **options)

    return copy


@pytest.fixture
def rewritten(tmp_path: Path) -> Editor:
    """Copies a recording with other messages."""
    return lambda source, messages, **options: rewrite(source, tmp_path / "rewritten.mcap", messages, **options)


@pytest.fixture
def at_tick() -> Callable[[int, Edit], Edit]:
    """An edit of the message of one tick alone."""
    return lambda tick, edit: lambda fields: edit(fields) if fields["tick"] == tick else fields


@pytest.fixture
def json_of() -> Iterator[Callable[[str], Any]]:
    """JSON, read."""
    yield from_json
