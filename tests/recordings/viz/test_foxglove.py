"""Foxglove's messages: their descriptors in the order in which a reader needs them, times, and transforms."""

import math

import pytest
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from google.protobuf import descriptor_pb2, descriptor_pool
from google.protobuf.timestamp_pb2 import Timestamp

from recordings.viz.drawn_world import DrawnWorld, decode_world
from recordings.viz.foxglove import FRAME_TRANSFORMS, LASER_SCAN, LOG, SCENE_UPDATE, descriptors, set_time
from recordings.viz.transforms import STEP_M, Transforms
from schemas.wire.part import encode


@pytest.mark.parametrize(
    "message", ["foxglove.FrameTransforms", "foxglove.SceneUpdate", "foxglove.Log", "foxglove.LaserScan"]
)
def test_a_reader_that_adds_the_files_in_their_order_finds_the_message(message):
    assert message in (FRAME_TRANSFORMS, SCENE_UPDATE, LOG, LASER_SCAN)
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(descriptors(message)).file:
        pool.Add(file)
    assert pool.FindMessageTypeByName(message).fields


@pytest.mark.parametrize("ns", [0, 999_999_999, 1_000_000_000, 5_400_020_000_000])
def test_a_time_is_seconds_and_nanoseconds(ns):
    timestamp = Timestamp()
    set_time(timestamp, ns)
    assert timestamp.ToNanoseconds() == ns


def world(**robots: tuple[float, float, float, float]) -> DrawnWorld:
    places = {name: dict(zip(("x", "y", "z", "heading"), place, strict=True)) for name, place in robots.items()}
    return decode_world(encode({"robots": places, "ball": {"x": 1.2, "y": -0.3, "z": 0.11}}))


def test_each_robot_and_the_ball_have_a_frame_in_the_map():
    name = "a_name_that_is_quite_long_1234"
    places = {"cyan1": (-10.2, 0.1, 0.4, 3.0), name: (0.0, -1e-9, 1.0, -3.1)}
    read = FrameTransforms.FromString(Transforms().encode(world(**places), 8_240_000_000)).transforms
    assert [one.child_frame_id for one in read] == ["cyan1/base_link", f"{name}/base_link", "ball", "ball/ground"]
    assert {one.parent_frame_id for one in read} == {"map"}
    assert {one.timestamp.ToNanoseconds() for one in read} == {8_240_000_000}
    for (x, y, z, heading), one in zip(places.values(), read, strict=False):
        assert (one.translation.x, one.translation.y, one.translation.z) == pytest.approx((x, y, z), abs=STEP_M)
        assert 2 * math.atan2(one.rotation.z, one.rotation.w) == pytest.approx(heading, abs=4 * STEP_M)
    ball, shadow = read[2], read[3]
    assert (ball.translation.x, ball.translation.y, ball.translation.z) == pytest.approx((1.2, -0.3, 0.11), abs=STEP_M)
    assert (shadow.translation.x, shadow.translation.z) == pytest.approx((1.2, 0.0), abs=STEP_M)


def test_pushed_obstacles_have_a_frame_on_the_ground_and_a_game_without_a_ball_has_none_for_it():
    robots = {"cyan1": {"x": 1.0, "y": 2.0, "z": 0.4, "heading": 0.0}}
    crate = {"x": -1.5, "y": 0.25, "heading": 2.5, "pushed": {"vx": 0.0, "vy": 0.0, "omega": 0.0, "mass": 3.0}}
    drawn = decode_world(
        encode({"robots": robots, "obstacles": {"crate": crate, "wall": {"x": 0.0, "y": 0.0}}, "ball": None})
    )
    _, box = FrameTransforms.FromString(Transforms().encode(drawn, 0)).transforms
    assert (box.child_frame_id, box.translation.z, box.rotation.x, box.rotation.y) == ("obstacle/crate", 0.0, 0.0, 0.0)
    assert (box.translation.x, box.translation.y) == pytest.approx((-1.5, 0.25), abs=STEP_M)
    assert 2 * math.atan2(box.rotation.z, box.rotation.w) == pytest.approx(2.5, abs=4 * STEP_M)
    ball = FrameTransforms.FromString(Transforms().encode(world(), 0)).transforms
    assert [(one.rotation.z, one.rotation.w) for one in ball] == [(0.0, 1.0)] * 2


def test_transforms_are_those_of_each_world_alone():
    transforms = Transforms()
    transforms.encode(world(cyan1=(-10.2, 0.1, 0.4, 3.0), cyan2=(1.0, 1.0, 1.0, 1.0)), 8_240_000_000)
    for later in (world(cyan1=(0.0, 0.0, 0.0, 0.0), cyan2=(0.0, 0.0, 0.0, 0.0)), world(cyan2=(1.0, 0.0, 0.4, 0.0))):
        assert transforms.encode(later, 0) == Transforms().encode(later, 0)
