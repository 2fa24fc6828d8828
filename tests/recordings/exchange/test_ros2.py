"""The bag is read back by two readers that know nothing of this project: rosbags and mcap-ros2-support."""

import json
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader

from recordings.exchange.ros2 import export
from recordings.reading.recording import Recording, open_recording
from schemas.config.match_config import load_match
from schemas.errors import TouchlineError
from schemas.frames import rotate
from schemas.messages.world import World
from schemas.topics import COMMAND, EVENT, STATE, WORLD

ROBOTS = ("cyan1", "cyan2", "magenta1", "magenta2")


@pytest.fixture(scope="module")
def bag(real: Recording, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export(real, tmp_path_factory.mktemp("bag") / "short").out


@pytest.fixture(scope="module")
def by_rosbags(bag: Path) -> dict[str, list[Any]]:
    """Topic → messages with their times in ns."""
    with AnyReader([bag]) as reader:
        found: dict[str, list[Any]] = {topic: [] for topic in reader.topics}
        for connection, time_ns, data in reader.messages():
            found[connection.topic].append((time_ns, reader.deserialize(data, connection.msgtype)))
    return found


@pytest.fixture(scope="module")
def by_mcap_ros2(bag: Path) -> dict[str, list[Any]]:
    found: dict[str, list[Any]] = {}
    with (bag / f"{bag.name}.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        for _, channel, message, decoded in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append((message.log_time, decoded))
    return found


def worlds(recording: Recording) -> list[World]:
    return [world for _, world in recording.decoded(WORLD.key)]


def stamp(header: Any) -> float:
    return float(header.stamp.sec + header.stamp.nanosec / 1e9)


@pytest.mark.parametrize("reader", ["by_rosbags", "by_mcap_ros2"])
def test_both_readers_find_every_robot_where_it_was(
    reader: str, real: Recording, request: pytest.FixtureRequest
) -> None:
    """Poses in `map` to the last bit; twists in the body frame."""
    found = request.getfixturevalue(reader)
    true = worlds(real)
    for name in ROBOTS:
        odometry = found[f"/{name}/odom"]
        assert len(odometry) == len(true)
        for (time_ns, message), world in zip(odometry, true, strict=True):
            robot = world.robots[name]
            place, turn, twist = message.pose.pose.position, message.pose.pose.orientation, message.twist.twist
            assert (place.x, place.y, place.z) == (robot.x, robot.y, robot.z)
            assert 2 * math.atan2(turn.z, turn.w) == pytest.approx(robot.heading, abs=1e-12)
            assert rotate(twist.linear.x, twist.linear.y, robot.heading) == pytest.approx(
                (robot.vx, robot.vy), abs=1e-12
            )
            assert twist.angular.z == robot.omega
            assert (message.header.frame_id, message.child_frame_id) == ("map", f"{name}/base_link")
            assert time_ns / 1e9 == pytest.approx(world.time) == pytest.approx(stamp(message.header))
    ball = [message.pose.pose.position.x for _, message in found["/ball/odom"]]
    assert ball == [world.ball.x for world in true]


def test_the_transforms_are_those_of_all_bodies_and_the_clock_tells_simulated_time(
    real: Recording, by_mcap_ros2: dict[str, list[Any]]
) -> None:
    true = worlds(real)
    for (_, message), world in zip(by_mcap_ros2["/tf"], true, strict=True):
        places = {one.child_frame_id: one.transform.translation for one in message.transforms}
        assert set(places) == {f"{name}/base_link" for name in ROBOTS} | {"ball"}
        assert places["cyan2/base_link"].x == world.robots["cyan2"].x
        assert places["ball"].z == world.ball.z
    clock = [message.clock.sec + message.clock.nanosec / 1e9 for _, message in by_mcap_ros2["/clock"]]
    assert clock == pytest.approx([world.time for world in true])


def test_commands_are_twists_under_each_robots_name(real: Recording, by_rosbags: dict[str, list[Any]]) -> None:
    for name in ROBOTS:
        asked = [command.drive for _, command in real.decoded(COMMAND.fill(robot=name))]
        found = [message for _, message in by_rosbags[f"/{name}/cmd_vel"]]
        assert [(one.linear.x, one.linear.y, one.angular.z) for one in found] == [
            (drive.vx, drive.vy, drive.omega) for drive in asked
        ]


def test_events_and_score_are_in_the_bag(real: Recording, by_mcap_ros2: dict[str, list[Any]]) -> None:
    events = [json.loads(message.data) for _, message in by_mcap_ros2["/game/event"]]
    assert [(event["tick"], event["kind"], event["text"]) for event in events] == [
        (event.tick, event.kind, event.text) for _, event in real.decoded(EVENT.key)
    ]
    states = [state for _, state in real.decoded(STATE.key)]
    assert [json.loads(message.data)["phase"] for _, message in by_mcap_ros2["/game/state"]] == [
        state.phase for state in states
    ]
    for side in ("cyan", "magenta"):
        score = [message.data for _, message in by_mcap_ros2[f"/game/score/{side}"]]
        assert score == [getattr(state.score, side) for state in states]


def test_beliefs_are_in_the_field_frame(match_recorder: Callable[..., None], tmp_path: Path) -> None:
    """A robot that plays in both directions believes itself to be near where it is."""
    match_recorder(tmp_path / "match.mcap", load_match(None), until=6.0)
    recording = open_recording(tmp_path / "match.mcap")
    true = {round(world.time, 6): world for world in worlds(recording)}
    with AnyReader([export(recording, tmp_path / "bag").out]) as reader:
        found = [(one.topic, at, reader.deserialize(data, one.msgtype)) for one, at, data in reader.messages()]
    for robot in ("cyan2", "magenta2"):
        poses = [(at, message) for topic, at, message in found if topic == f"/{robot}/belief/pose"]
        assert len(poses) > 10
        for at, message in poses:
            place, truth = message.pose.position, true[round(at / 1e9, 6)].robots[robot]
            assert math.dist((place.x, place.y), (truth.x, truth.y)) < 1.0
            assert message.header.frame_id == "map"
        texts = [json.loads(message.data) for topic, _, message in found if topic == f"/{robot}/belief"]
        assert {text["robot"] for text in texts} == {robot}
    balls = [(at, message) for topic, at, message in found if topic.endswith("/belief/ball")]
    near = [
        math.dist(
            (message.point.x, message.point.y), (true[round(at / 1e9, 6)].ball.x, true[round(at / 1e9, 6)].ball.y)
        )
        for at, message in balls
    ]
    assert sorted(near)[len(near) // 2] < 0.5


def test_the_bag_has_the_profile_and_the_quality_of_service_that_ros_asks_for(bag: Path) -> None:
    """Profile `ros2`, CDR throughout, `offered_qos_profiles` with each channel: rosbag2 refuses a bag without."""
    with (bag / f"{bag.name}.mcap").open("rb") as file:
        reader = make_reader(file)
        summary = reader.get_summary()
        assert summary is not None and reader.get_header().profile == "ros2"
    assert {channel.message_encoding for channel in summary.channels.values()} == {"cdr"}
    assert {schema.encoding for schema in summary.schemas.values()} == {"ros2msg"}
    for channel in summary.channels.values():
        (offered,) = yaml.safe_load(channel.metadata["offered_qos_profiles"])
        never = {"sec": 2147483647, "nsec": 4294967295}
        is_clock = channel.topic == "/clock"
        assert offered == {
            "history": "keep_last",
            "depth": 1 if is_clock else offered["depth"],
            "reliability": "best_effort" if is_clock else "reliable",
            "durability": "volatile",
            "deadline": never,
            "lifespan": never,
            "liveliness": "automatic",
            "liveliness_lease_duration": never,
            "avoid_ros_namespace_conventions": False,
        }
        assert offered["depth"] > 1 or is_clock
    assert "storage_identifier: mcap" in (bag / "metadata.yaml").read_text()


def test_without_rosbags_the_error_names_the_remedy(
    real: Recording, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "rosbags", None)
    with pytest.raises(TouchlineError, match=r"pip install 'touchline\[ros2\]'"):
        export(real, tmp_path / "bag")
    assert not (tmp_path / "bag").exists()
