"""What is written is what Foxglove's own package defines: by its descriptors, and read back by its classes."""

import pytest
from foxglove_schemas_protobuf import FrameTransforms_pb2, Log_pb2, SceneUpdate_pb2
from google.protobuf import descriptor_pb2, descriptor_pool
from pydantic_core import to_json

from recordings.viz.drawn_world import decode_world
from recordings.viz.foxglove import FRAME_TRANSFORMS, LOG, SCENE_UPDATE, descriptors, encode, timestamp
from recordings.viz.transforms import STEP_M, Transforms

THEIRS = {
    FRAME_TRANSFORMS: FrameTransforms_pb2.FrameTransforms,
    SCENE_UPDATE: SceneUpdate_pb2.SceneUpdate,
    LOG: Log_pb2.Log,
}


def pool_of(message: str) -> descriptor_pool.DescriptorPool:
    """As a reader fills it: in the order in which the files stand."""
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(descriptors(message)).file:
        pool.Add(file)
    return pool


def said(message, found: dict) -> dict:
    """Message → its fields, and enumeration → its members, of a descriptor and of all below it."""
    if message.full_name not in found:
        found[message.full_name] = [
            (field.name, field.number, field.type, field.is_repeated, field.has_presence) for field in message.fields
        ]
        for field in message.fields:
            if field.message_type is not None:
                said(field.message_type, found)
            if field.enum_type is not None:
                found[field.enum_type.full_name] = [(value.name, value.number) for value in field.enum_type.values]
    return found


@pytest.mark.parametrize("message", THEIRS)
def test_the_descriptors_are_those_of_foxglove_field_by_field(message):
    ours = said(pool_of(message).FindMessageTypeByName(message), {})
    assert ours == said(THEIRS[message].DESCRIPTOR, {})
    assert message in ours


def test_every_kind_of_field_is_read_back_as_it_was_written():
    values = {
        "deletions": [{"timestamp": timestamp(3), "type": "ALL", "id": "gone"}],
        "entities": [
            {
                "timestamp": {"seconds": 7, "nanos": 9},
                "id": "körper",
                "lifetime": {"seconds": -2},
                "frame_locked": True,
                "metadata": [{"key": "a", "value": ""}],
                "lines": [{"type": "LINE_LIST", "points": [{"x": 1.5, "z": -0.25}, {}], "indices": [0, 4_000_000_000]}],
                "models": [{"data": b"\x00\xff", "override_color": False}],
            }
        ],
    }
    read = SceneUpdate_pb2.SceneUpdate.FromString(encode(SCENE_UPDATE, values))
    [deletion], [entity] = read.deletions, read.entities
    assert (deletion.timestamp.nanos, deletion.type, deletion.id) == (3, 1, "gone")
    assert (entity.timestamp.seconds, entity.timestamp.nanos, entity.lifetime.seconds) == (7, 9, -2)
    assert (entity.id, entity.frame_locked) == ("körper", True)
    assert [(pair.key, pair.value) for pair in entity.metadata] == [("a", "")]
    assert (
        entity.lines[0].type
        == SceneUpdate_pb2.SceneUpdate.DESCRIPTOR.fields_by_name["entities"]
        .message_type.fields_by_name["lines"]
        .message_type.enum_types_by_name["Type"]
        .values_by_name["LINE_LIST"]
        .number
    )
    assert [(point.x, point.y, point.z) for point in entity.lines[0].points] == [(1.5, 0.0, -0.25), (0.0, 0.0, 0.0)]
    assert list(entity.lines[0].indices) == [0, 4_000_000_000]
    assert entity.models[0].data == b"\x00\xff"


@pytest.mark.parametrize("ns", [0, 999_999_999, 1_000_000_000, 5_400_020_000_000])
def test_a_stamp_is_seconds_and_nanoseconds(ns):
    read = Log_pb2.Log.FromString(encode(LOG, {"timestamp": timestamp(ns)}))
    assert read.timestamp.ToNanoseconds() == ns


def test_transforms_put_together_by_hand_are_those_of_the_table():
    world = {
        "robots": {
            "cyan1": {"x": -10.2, "y": 0.1, "z": 0.4, "heading": 3.0},
            "a_name_that_is_quite_long_1234": {"x": 0.0, "y": -1e-9, "z": 1.0, "heading": -3.1},
        },
        "ball": {"x": 1.2, "y": -0.3, "z": 0.11},
    }
    written = Transforms().encode(decode_world(to_json(world)), 8_240_000_000)
    read = FrameTransforms_pb2.FrameTransforms.FromString(written)
    assert read.SerializeToString() != b""
    plain = [
        {
            "timestamp": timestamp(8_240_000_000),
            "parent_frame_id": one.parent_frame_id,
            "child_frame_id": one.child_frame_id,
            "translation": {"x": one.translation.x, "y": one.translation.y, "z": one.translation.z},
            "rotation": {"z": one.rotation.z, "w": one.rotation.w},
        }
        for one in read.transforms
    ]
    assert FrameTransforms_pb2.FrameTransforms.FromString(encode(FRAME_TRANSFORMS, {"transforms": plain})) == read
    assert [one.child_frame_id for one in read.transforms] == [
        "cyan1/base_link",
        "a_name_that_is_quite_long_1234/base_link",
        "ball",
        "ball/ground",
    ]
    assert read.transforms[0].translation.x == pytest.approx(-10.2, abs=STEP_M)
