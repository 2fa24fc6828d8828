import json

import pytest

from recordings.json_schema import flat_schema, whole_schema
from schemas.message import Message
from schemas.topics import TOPICS

MODELS = {
    topic.message.__name__: topic.message for topic in TOPICS.values() if topic.recorded or topic.key.endswith("sight")
}

SCALARS = {"boolean", "string", "number", "integer"}


def refused(schema: dict, path: str = "$") -> list[str]:
    """What a viewer would not read: an object has properties, a field one plain type, an array scalars or objects."""
    if schema.get("type") != "object":
        return [f"{path} is no object"]
    if not isinstance(schema.get("properties"), dict):
        return [f"{path} has no properties"]
    found = []
    for name, field in schema["properties"].items():
        where = f"{path}.{name}"
        kind = field.get("type")
        if kind == "array":
            items = field.get("items", {})
            if items.get("type") == "object":
                found += refused(items, where + "[]")
            elif items.get("type") not in SCALARS:
                found.append(f"{where}[] is {items.get('type')}")
        elif kind == "object":
            found += refused(field, where)
        elif kind not in SCALARS:
            found.append(f"{where} is {kind}")
    return found


@pytest.mark.parametrize("name", sorted(MODELS))
def test_a_viewer_reads_the_flattened_schema_of_every_recorded_message(name):
    assert refused(flat_schema(MODELS[name])) == []


@pytest.mark.parametrize("name", sorted(MODELS))
def test_no_reference_and_no_union_is_left(name):
    text = json.dumps(flat_schema(MODELS[name]))
    assert not any(word in text for word in ("$ref", "$defs", "anyOf", "oneOf", '"null"', "prefixItems"))


@pytest.mark.parametrize("name", sorted(MODELS))
def test_every_field_of_the_message_is_still_there(name):
    assert list(flat_schema(MODELS[name])["properties"]) == [
        field.alias or name for name, field in MODELS[name].model_fields.items()
    ]


def test_the_whole_schema_is_what_a_viewer_refuses():
    assert refused(whole_schema(MODELS["World"]))


def test_an_optional_part_is_flattened_to_the_part():
    kick = flat_schema(MODELS["Command"])["properties"]["kick"]
    assert {name: field["type"] for name, field in kick["properties"].items()} == {"mode": "string", "speed": "number"}


def test_what_stands_below_the_robots_names_is_told():
    robots = flat_schema(MODELS["World"])["properties"]["robots"]
    assert robots["additionalProperties"]["properties"]["heading"]["type"] == "number"


def test_a_field_of_two_types_is_refused_with_a_remedy():
    class Undecided(Message):
        value: int | str

    with pytest.raises(ValueError, match="several types"):
        flat_schema(Undecided)
