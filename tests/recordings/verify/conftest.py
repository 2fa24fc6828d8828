"""Recordings to verify, and copies of them with changes."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer
from pydantic_core import from_json, to_json

from recordings.container.sealed_metadata import sealed
from schemas.config.match_config import load_match
from schemas.config.roster import Placement
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from schemas.messages.scene import SceneOperation, SceneRequest
from sim_host.match.simulation import Simulation

Fields = dict[str, Any]
Edit = Callable[[Fields], Fields | None]
"""What becomes of a message: its fields, or nothing when it is left out."""

POST = {"name": "post", "shape": "cylinder", "place": [2.0, -3.0], "radius": 0.15, "height": 0.9}


def operate(simulation: Simulation) -> None:
    """Three deeds, each of which makes a checkpoint."""
    match simulation.world.tick:
        case 260:
            place = [Placement(body="ball", x=1.0, y=2.0, vx=-1.0, vy=0.5)]
            assert simulation.handle_scene(SceneRequest(operation=SceneOperation.PLACE, place=place)).accepted
        case 320:
            values = {"drive.max_speed": 3.0, "ball.rolling_deceleration": 0.8}
            assert simulation.handle_parameters(
                ParametersRequest(operation=ParameterOperation.SET, values=values)
            ).accepted
        case 380:
            request = SceneRequest(operation=SceneOperation.ADD, obstacles=[POST])
            assert simulation.handle_scene(request).accepted


@pytest.fixture(name="operate")
def operate_fixture() -> Callable[[Simulation], None]:
    """What the operator of `operated` does."""
    return operate


@pytest.fixture(scope="session")
def operated(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> Path:
    """A match of two a side on wheels: two kick-offs, and three deeds of an operator; 600 ticks or so."""
    path = tmp_path_factory.mktemp("operated") / "match.mcap"
    teams = {"teams.cyan.size": 2, "teams.magenta.size": 2}
    config = load_match(None, {"seed": 3, "duration": 10.0, "profile": "omni", **teams})
    match_recorder(path, config, until=14.0, between=operate)
    return path


Editor = Callable[..., Path]


@pytest.fixture
def edited(tmp_path: Path) -> Editor:
    """Copies a recording with other messages of one key, attachments or metadata; every checksum is right again."""

    def copy(source: Path, key: str, edit: Edit, metadata: Callable[[str, Fields], Fields] = lambda _, it: it) -> Path:
        path = tmp_path / "edited.mcap"
        with source.open("rb") as file, path.open("wb") as out:
            reader, writer = make_reader(file), Writer(out)
            writer.start(profile="", library="touchline/test")
            for record in reader.iter_metadata():
                writer.add_metadata(record.name, sealed(metadata(record.name, record.metadata)))
            for attachment in reader.iter_attachments():
                writer.add_attachment(0, 0, attachment.name, attachment.media_type, attachment.data)
            schemas: dict[int, int] = {}
            channels: dict[int, int] = {}
            for schema, channel, message in reader.iter_messages(log_time_order=False):
                assert schema is not None
                if channel.id not in channels:
                    number = writer.register_schema(schema.name, schema.encoding, schema.data)
                    schemas[schema.id] = number
                    channels[channel.id] = writer.register_channel(
                        channel.topic, channel.message_encoding, number, channel.metadata
                    )
                data = message.data
                if channel.topic == key:
                    fields = edit(from_json(data))
                    if fields is None:
                        continue
                    data = to_json(fields)
                where = channels[channel.id]
                writer.add_message(where, message.log_time, data, message.publish_time, message.sequence)
            writer.finish()
        return path

    return copy


@pytest.fixture
def at_tick() -> Callable[[int, Edit], Edit]:
    """An edit of the message of one tick alone."""
    return lambda tick, edit: lambda fields: edit(fields) if fields["tick"] == tick else fields


@pytest.fixture
def json_of() -> Iterator[Callable[[str], Any]]:
    """JSON, read."""
    yield from_json
