"""The channels for viewers in a file: stock readers read them, and other tools ignore them."""

from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

from recordings.container.key_selection import KeySelection
from recordings.editing.filtering import filter_recording
from recordings.exchange.csv_files import export
from recordings.inspection.difference import compare
from recordings.inspection.recording_facts import facts_of
from recordings.reading.cursor import Cursor
from recordings.reading.recording import open_recording
from recordings.soccer.stats.match_statistics import figures_of_recording
from recordings.viz.drawing import BALL, DRAWINGS, EVENTS, FIELD, GAME, ROBOTS, SCHEMAS, TF
from schemas.config.match_config import load_match
from schemas.config.settings import RecordOptions
from schemas.soccer.game import Phase, Score
from touchline.verify.resimulate import verify

ALWAYS = sorted(SCHEMAS.keys() - {DRAWINGS})
"""Channels of a match whose brains draw nothing."""


def drawn(path: Path) -> list[tuple[str, int, bytes]]:
    """Topic, log time and payload of what is there for viewers, in the order of the file."""
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        every = reader.iter_messages(topics=list(SCHEMAS), log_time_order=False)
        return [(channel.topic, message.log_time, message.data) for _, channel, message in every]


@pytest.fixture(scope="module")
def plain(match_recorder, tmp_path_factory) -> Path:
    """The beginning of the match of `played`, recorded without what viewers draw."""
    path = tmp_path_factory.mktemp("plain") / "match.mcap"
    match_recorder(path, load_match(None, {"seed": 7, "duration": 60.0}), until=3.0, options=RecordOptions(viz=False))
    return path


@pytest.fixture(scope="module")
def short(match_recorder, tmp_path_factory) -> Path:
    """The same with it."""
    path = tmp_path_factory.mktemp("short") / "match.mcap"
    match_recorder(path, load_match(None, {"seed": 7, "duration": 60.0}), until=3.0)
    return path


def test_a_stock_reader_decodes_every_message_from_the_file_alone(short):
    found: dict[str, list] = {}
    with short.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for schema, channel, message, decoded in reader.iter_decoded_messages(topics=list(SCHEMAS)):
            assert (schema.name, schema.encoding, channel.message_encoding) == (
                SCHEMAS[channel.topic],
                "protobuf",
                "protobuf",
            )
            found.setdefault(channel.topic, []).append((message.log_time, decoded))
    worlds = list(open_recording(short).decoded("world"))
    transforms = found[TF]
    assert [log_ns for log_ns, _ in transforms] == [recorded.log_ns for recorded, _ in worlds]
    for (_, said), (recorded, world) in zip(transforms, worlds, strict=True):
        places = {one.child_frame_id: one.translation for one in said.transforms}
        assert {one.timestamp.ToNanoseconds() for one in said.transforms} == {recorded.log_ns}
        assert places["ball"].x == pytest.approx(world.ball.x, abs=1e-4)
        for name, robot in world.robots.items():
            assert places[f"{name}/base_link"].y == pytest.approx(robot.y, abs=1e-4)
    robots = {entity.id for entity in found[ROBOTS][0][1].entities}
    assert robots == set(worlds[0][1].robots)
    assert [entry.message for _, entry in found[EVENTS]] == [
        event.text for _, event in open_recording(short).decoded("game/event")
    ]
    assert {FIELD, BALL, GAME} <= set(found)


def test_times_and_numbers_are_those_of_the_messages_it_comes_from(short):
    with short.open("rb") as file:
        messages = [
            (channel.topic, message)
            for _, channel, message in make_reader(file).iter_messages(topics=["world", TF], log_time_order=False)
        ]
    for (first, world), (second, transforms) in zip(messages[::2], messages[1::2], strict=True):
        assert (first, second) == ("world", TF)
        assert (world.log_time, world.publish_time, world.sequence) == (
            transforms.log_time,
            transforms.publish_time,
            transforms.sequence,
        )


def test_readers_of_recordings_do_not_see_it(short, plain):
    seen, bare = open_recording(short), open_recording(plain)
    assert [channel.key for channel in seen.channels] == [channel.key for channel in bare.channels]
    assert [message.key for message in seen.messages()] == [message.key for message in bare.messages()]
    assert (seen.drawn[TF], bare.drawn) == (151, {})
    cursor, count = Cursor(short), 0
    while (message := cursor.peek()) is not None:
        assert not message.key.startswith("/")
        cursor.skip()
        count += 1
    assert count == sum(channel.messages for channel in seen.channels)


def test_with_or_without_it_a_recording_is_the_same_match(short, plain, tmp_path):
    seen, bare = open_recording(short), open_recording(plain)
    assert compare(seen, bare).identical
    assert verify(short).identical
    assert figures_of_recording(seen).to_json() == figures_of_recording(bare).to_json()
    assert seen.result is not None and bare.result is not None
    assert seen.result.keys == bare.result.keys
    written = export(seen, tmp_path / "seen").written
    assert written == export(bare, tmp_path / "bare").written
    assert facts_of(seen).messages == facts_of(bare).messages


def test_a_copy_of_a_part_is_drawn_anew(short, tmp_path):
    filter_recording(open_recording(short), tmp_path / "part.mcap", start=1.0, end=2.0)
    topics = [topic for topic, log_ns, _ in drawn(tmp_path / "part.mcap") if log_ns < round(1e9)]
    assert {FIELD, ROBOTS, BALL, TF, GAME} <= set(topics), "as things stood when it begins"
    times = [log_ns for topic, log_ns, _ in drawn(tmp_path / "part.mcap") if topic == TF and log_ns >= round(1e9)]
    assert times == list(range(1_000_000_000, 2_000_000_000, 20_000_000))


def test_a_copy_without_the_world_has_nothing_to_draw_but_the_game(short, tmp_path):
    filter_recording(open_recording(short), tmp_path / "part.mcap", KeySelection(exclude=("world",)))
    assert set(open_recording(tmp_path / "part.mcap").drawn) <= {GAME, EVENTS}


def test_every_part_of_a_recording_is_drawn_whole_and_their_copy_as_one_file(make_rig, tmp_path):
    rig = make_rig(options=RecordOptions(part_duration=0.5))
    rig.begin()
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(100))
    rig.leave()
    assert len(rig.sink.files) > 2
    for part in rig.sink.files:
        first = [topic for topic, _, _ in drawn(part)][:6]
        assert {FIELD, ROBOTS, BALL, GAME, TF} <= set(first)
    filter_recording(open_recording(rig.path), tmp_path / "copy.mcap")
    whole = make_rig(path=tmp_path / "whole.mcap")
    whole.begin()
    whole.host.referee(0, Phase.PLAY, Score())
    whole.play(range(100))
    whole.leave()
    assert sorted(drawn(tmp_path / "copy.mcap")) == sorted(drawn(whole.path))


def test_without_a_setup_nothing_is_drawn(make_rig):
    rig = make_rig()
    rig.host.play(0)
    rig.leave()
    recording = rig.read()
    assert recording.manifest.setup is None
    assert (recording.drawn, len(list(recording.messages()))) == ({}, 6)
