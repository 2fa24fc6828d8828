"""Every field has a description, which `touchline schema`, recordings and the page on the protocol show."""

import dataclasses
from collections.abc import Iterator
from typing import Any, get_args, get_type_hints

import pytest
from pydantic import BaseModel

from protocol_fields import rows
from recordings.container.json_schema import flat_schema, whole_schema
from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.config.scene import Scene
from schemas.config.soccer.rule_book import RuleBook
from schemas.messages.manual import ManualDrive
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.messages.world import World
from schemas.topics import TOPICS
from schemas.wire.json_schema import json_schema
from schemas.wire.part import Part

ROOTS = [kind for topic in TOPICS.values() for kind in (topic.message, topic.reply) if kind is not None]


def parts(kind: Any, met: dict[type, None]) -> Iterator[type]:
    """A model or a dataclass, and all that its fields are made of, each once."""
    if isinstance(kind, type) and (issubclass(kind, BaseModel | Part) or dataclasses.is_dataclass(kind)):
        if kind in met:
            return
        met[kind] = None
        yield kind
        for hint in get_type_hints(kind, include_extras=True).values():
            yield from parts(hint, met)
    for inner in get_args(kind):
        yield from parts(inner, met)


def all_parts() -> list[type]:
    met: dict[type, None] = {}
    return [part for root in (*ROOTS, MatchConfig, Profile, RuleBook, Scene) for part in parts(root, met)]


@pytest.mark.parametrize("part", all_parts(), ids=lambda part: part.__name__)
def test_every_field_has_a_description(part: type) -> None:
    own = part.model_json_schema() if issubclass(part, BaseModel) else json_schema(part)
    fields = own.get("properties", {})
    assert [name for name, field in fields.items() if not field.get("description")] == []


def test_a_number_of_a_profile_is_described_with_its_unit() -> None:
    pitch = whole_schema(Setup)["$defs"]["Pitch"]["properties"]
    assert pitch["length"]["description"] == "goal line to goal line, outer edges, along x; m"
    drive = whole_schema(Setup)["$defs"]["RobotModel"]["properties"]["drive"]
    assert drive["description"] == "Limits of the drive."


def test_the_schema_beside_a_channel_describes_what_is_deep_inside() -> None:
    robot = flat_schema(World)["properties"]["robots"]["additionalProperties"]["properties"]
    assert robot["heading"]["description"] == "Kicking direction in the field frame, counter-clockwise from +x, in rad."


def test_the_protocol_page_has_the_same_descriptions() -> None:
    described = {row.name: row.meaning for row in rows(World, str)}
    assert described["ball"] == whole_schema(World)["properties"]["ball"]["description"]


def test_the_schema_of_a_struct_describes_it_and_the_structs_in_it() -> None:
    schema = Sight.json_schema()
    assert schema["properties"]["holding"]["description"] == "The robot holds the ball: only then can it kick."
    assert schema["properties"]["self"] == {
        "$ref": "#/$defs/Motion",
        "description": "The robot's own pose and twist, as it measures them.",
    }
    motion = schema["$defs"]["Motion"]
    assert motion["description"] == "Pose and twist of a robot in its team frame."
    assert motion["properties"]["x"]["description"] == "x of the centre in the team frame, in m."


def test_the_description_of_a_field_does_not_replace_that_of_its_type() -> None:
    schema = ManualDrive.json_schema()
    assert schema["properties"]["drive"]["description"] == "Velocity demand in the body frame."
    assert schema["$defs"]["Drive"]["description"].startswith("A velocity demand in the body frame: x in the kicking")
