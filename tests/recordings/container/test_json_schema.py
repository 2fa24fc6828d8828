import json

import pytest
from mcap.reader import make_reader

from recordings.container.json_schema import flat_schema, whole_schema
from schemas.config.match_config import load_match
from schemas.topics import TOPICS
from schemas.wire.message import Message
from support.recorder_rig import ROBOTS

MODELS = {
    topic.message.__name__: topic.message for topic in TOPICS.values() if topic.recorded or topic.key.endswith("sight")
}

SCALARS = {"boolean": "bool", "string": "string", "number": "float64", "integer": "float64"}


def datatypes(schema: dict, name: str) -> dict[str, list[tuple[str, str]]]:
    """What Lichtblick's parser makes of a schema: type → its fields with their types; raises where that raises.

    It takes objects with properties, and as fields booleans, texts that are plain or base64, numbers, objects, and
    lists of plain texts, numbers, booleans and objects; nothing else, no references, no unions, no lists of lists.
    """
    found: dict[str, list[tuple[str, str]]] = {}
    if schema.get("type") != "object":
        raise ValueError(f"{name} is {schema.get('type')}, no object")
    fields = found[name] = []
    for field, content in schema["properties"].items():
        kind, below = content.get("type"), f"{name}.{field}"
        if kind == "array":
            items = content["items"]
            if items.get("type") == "object":
                found |= datatypes(items, below)
                fields.append((field, f"{below}[]"))
            elif items.get("type") in SCALARS and "contentEncoding" not in items:
                fields.append((field, f"{SCALARS[items['type']]}[]"))
            else:
                raise ValueError(f"{below} is a list of {items}")
        elif kind == "object":
            found |= datatypes(content, below)
            fields.append((field, below))
        elif kind in SCALARS and content.get("contentEncoding") in (None, "base64"):
            fields.append((field, "uint8[]" if "contentEncoding" in content else SCALARS[kind]))
        else:
            raise ValueError(f"{below} is {content}")
    return found


@pytest.mark.parametrize("name", sorted(MODELS))
def test_a_viewer_reads_the_flattened_schema_of_every_recorded_message(name):
    assert datatypes(flat_schema(MODELS[name]), name)[name]


def test_a_viewer_reads_the_schema_of_every_channel_of_a_recording(match_recorder, tmp_path):
    """As it stands in the file, the schemas of all topics that a match has."""
    match_recorder(tmp_path / "match.mcap", load_match(None), until=1.0)
    with (tmp_path / "match.mcap").open("rb") as file:
        schemas = make_reader(file).get_summary().schemas.values()
    texts = {schema.name: json.loads(schema.data) for schema in schemas if schema.encoding == "jsonschema"}
    assert {"touchline.World", "touchline.Command", "touchline.GameState", "touchline.Belief"} <= set(texts)
    for name, schema in texts.items():
        assert datatypes(schema, name)
    world = datatypes(texts["touchline.World"], "touchline.World")
    assert ("x", "float64") in world["touchline.World.ball"]
    robots = [f"{side}{number}" for side in ("cyan", "magenta") for number in range(1, 6)]
    for robot in robots:
        assert ("x", "float64") in world[f"touchline.World.robots.{robot}"]
    applied = datatypes(texts["touchline.Applied"], "touchline.Applied")
    assert ("vx", "float64") in applied["touchline.Applied.inputs.magenta5.drive"]


@pytest.mark.parametrize("name", sorted(MODELS))
def test_every_field_of_the_message_is_still_there(name):
    assert tuple(flat_schema(MODELS[name])["properties"]) == MODELS[name].__struct_fields__


def test_the_whole_schema_is_what_a_viewer_refuses():
    with pytest.raises((ValueError, KeyError)):
        datatypes(whole_schema(MODELS["World"]), "World")


def test_an_optional_part_is_flattened_to_the_part():
    kick = flat_schema(MODELS["Command"])["properties"]["kick"]
    assert {name: field["type"] for name, field in kick["properties"].items()} == {"mode": "string", "speed": "number"}


def test_the_schema_describes_the_fields_below_the_names_of_robots():
    robots = flat_schema(MODELS["World"])["properties"]["robots"]
    assert robots["additionalProperties"]["properties"]["heading"]["type"] == "number"


@pytest.mark.parametrize(("message", "field"), [("World", "robots"), ("Applied", "inputs"), ("GameState", "robots")])
def test_each_robot_of_the_roster_is_a_member_of_what_is_told_by_robot(message, field):
    schema = flat_schema(MODELS[message], ["striker", "keeper"])["properties"][field]
    assert list(schema["properties"]) == ["striker", "keeper"]
    assert schema["properties"]["striker"] == schema["additionalProperties"]


def test_a_list_of_robots_is_left_as_it_is():
    """The roster that an operator changed stands in the same message as the inputs by robot."""
    assert flat_schema(MODELS["Applied"], ["striker"])["properties"]["robots"]["type"] == "array"


def test_a_robot_that_joins_later_is_read_with_the_schema_of_the_others(make_rig):
    rig = make_rig()
    rig.begin()
    rig.play(range(5))
    rig.host.play(5, guests=("guest",))
    rig.leave()
    with rig.path.open("rb") as file:
        reader = make_reader(file)
        schema = next(one for one in reader.get_summary().schemas.values() if one.name == "touchline.World")
    assert list(json.loads(schema.data)["properties"]["robots"]["properties"]) == [*ROBOTS]
    worlds = [world for _, world in rig.read().decoded("world")]
    assert "guest" in worlds[-1].robots


def test_a_field_of_two_types_is_refused_with_a_remedy():
    class Undecided(Message):
        value: int | str

    with pytest.raises(ValueError, match="several types"):
        flat_schema(Undecided)
