"""Every field has a description, which `touchline schema`, recordings and the page on the protocol show."""

import dataclasses
from collections.abc import Iterator
from typing import Any, get_args, get_type_hints

import pytest
from pydantic import BaseModel, TypeAdapter

from recordings.container.json_schema import flat_schema, whole_schema
from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.config.rule_book import RuleBook
from schemas.config.scene import Scene
from schemas.game import DisciplinaryRecord, GameView, Point
from schemas.messages import command, sight
from schemas.messages.coach import CoachOrder
from schemas.messages.host import Setup
from schemas.messages.world import World
from schemas.protocol.fields import rows
from schemas.topics import TOPICS

ROOTS = [kind for topic in TOPICS.values() for kind in (topic.message, topic.reply) if kind is not None]
STRUCTS = {
    CoachOrder,
    GameView,
    Point,
    DisciplinaryRecord,
    *(kind for module in (command, sight) for kind in vars(module).values() if isinstance(kind, type)),
}
"""Their fields are described by their class and their types."""


def parts(kind: Any, met: dict[type, None]) -> Iterator[type]:
    """A model or a dataclass, and all that its fields are made of, each once."""
    if isinstance(kind, type) and (issubclass(kind, BaseModel) or dataclasses.is_dataclass(kind)):
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


@pytest.mark.parametrize("part", [part for part in all_parts() if part not in STRUCTS], ids=lambda part: part.__name__)
def test_every_field_has_a_description(part: type) -> None:
    schema = TypeAdapter(part).json_schema(mode="serialization")
    own = schema if "properties" in schema else schema.get("$defs", {}).get(part.__name__, {})
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


def test_the_page_on_the_protocol_says_the_same() -> None:
    described = {row.name: row.meaning for row in rows(World, str)}
    assert described["ball"] == whole_schema(World)["properties"]["ball"]["description"]
