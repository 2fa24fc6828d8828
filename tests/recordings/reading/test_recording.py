import pytest
from mcap.reader import make_reader
from mcap.writer import Writer

from recordings.container.manifest import MANIFEST
from recordings.container.mcap_file import open_mcap_file
from recordings.container.sealed_metadata import sealed
from recordings.reading.recording import open_recording
from schemas.errors import TouchlineError
from schemas.topics import COMMAND


def cut(path, share: float):
    data = path.read_bytes()
    shorter = path.with_name("cut.mcap")
    shorter.write_bytes(data[: round(len(data) * share)])
    return shorter


def test_channels_have_counts_and_times(recorded):
    channels = {channel.key: channel for channel in recorded.channels}
    assert len(channels) == 8
    world = channels["world"]
    assert (world.topic, world.messages) == ("world", 200)
    assert (world.start, world.end) == (0.0, 3.98)


def test_messages_are_chosen_by_key_pattern_and_simulated_time(recorded):
    chosen = list(recorded.messages(COMMAND.fill(), "world", start=1.0, end=1.1))
    assert sorted({message.key for message in chosen}) == [
        "robot/cyan1/command",
        "robot/cyan2/command",
        "robot/magenta1/command",
        "robot/magenta2/command",
        "world",
    ]
    assert {message.time for message in chosen} == {1.0, 1.02, 1.04, 1.06, 1.08}
    assert len(chosen) == 25


def test_no_two_metadata_records_have_one_name_and_a_damaged_manifest_is_read_from_its_copy(recorded, tmp_path):
    with recorded.path.open("rb") as source:
        names = [one.name for one in make_reader(source).iter_metadata()]
    assert names == ["manifest", "manifest_copy", "result"]
    content, path = bytearray(recorded.path.read_bytes()), tmp_path / "flipped.mcap"
    content[content.index(b"contract") + 12] ^= 1
    path.write_bytes(content)
    assert open_recording(path).manifest == recorded.manifest


def test_a_message_later_than_any_match_is_named(recorded, tmp_path):
    path = tmp_path / "late.mcap"
    with recorded.path.open("rb") as source, path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        for one in make_reader(source).iter_metadata():
            writer.add_metadata(one.name, one.metadata)
        channel = writer.register_channel("world", "json", 0, {"topic": "world"})
        writer.add_message(channel, 2**64 - 5, b"{}", 0)
        writer.finish()
    with pytest.raises(TouchlineError, match=r"late.mcap: world has a message at 1.84e\+10 s; no match lasts so long"):
        open_recording(path)


@pytest.mark.parametrize("share", [0.35, 0.999])
def test_a_truncated_file_is_readable_up_to_the_cut(make_rig, share):
    rig = make_rig()
    rig.begin()
    clock = rig.recorder_bus.clock
    for tick in range(1200):
        rig.host.play(tick)
        clock.sleep_until(clock.now() + 0.02)
        rig.recorder.pump()
    rig.leave()
    whole = [message.payload for message in rig.read().messages()]

    recording = open_recording(cut(rig.path, share))
    rest = [message.payload for message in recording.messages()]
    assert not recording.complete
    assert recording.manifest == rig.read().manifest
    assert 0 < len(rest) <= len(whole)
    assert rest == whole[: len(rest)]
    assert sum(channel.messages for channel in recording.channels) == len(rest)
    assert len(list(recording.messages("world", start=0.2, end=0.4))) == 10


def test_a_file_that_is_still_written_may_have_got_its_channels_since_it_was_looked_into(recorded):
    """As seen once: the first chunk was written between the look and the reading."""
    begun = recorded.path.with_name("begun.mcap")
    data = recorded.path.read_bytes()
    with recorded.path.open("rb") as file:
        first = make_reader(file).get_summary().chunk_indexes[0]
    begun.write_bytes(data[: first.chunk_start_offset])
    recording = open_recording(begun)
    begun.write_bytes(data[: first.chunk_start_offset + first.chunk_length])
    assert list(recording.messages("world")) == []
    assert len(list(open_recording(begun).messages("world"))) > 0


def test_a_truncated_file_is_refused_by_name_where_a_whole_one_is_needed(recorded):
    with pytest.raises(TouchlineError, match="truncated file"):
        open_recording(cut(recorded.path, 0.9), whole=True)


@pytest.mark.parametrize("size", [0, 5, 20])
def test_a_file_cut_off_before_its_manifest_is_reported_as_such(recorded, size):
    path = recorded.path.with_name("stump.mcap")
    path.write_bytes(recorded.path.read_bytes()[:size])
    with pytest.raises(TouchlineError, match="before its manifest"):
        open_recording(path)


def test_anything_else_is_not_a_recording(tmp_path):
    path = tmp_path / "table.mcap"
    path.write_bytes(b"tick,x,y\n1,2,3\n")
    with pytest.raises(TouchlineError, match="not a recording"):
        open_recording(path)


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(TouchlineError, match=r"gone\.mcap: No such file"):
        open_recording(tmp_path / "gone.mcap")


def test_an_mcap_file_of_another_program_is_not_a_recording_of_a_match(tmp_path):
    path = tmp_path / "other.mcap"
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        writer.finish()
    with pytest.raises(TouchlineError, match="without a manifest"):
        open_recording(path)


def with_manifest(recorded, path, **changes):
    """A file with nothing but the manifest of a recording, changed."""
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        writer.add_metadata("manifest", sealed({**open_mcap_file(recorded.path).metadata[MANIFEST], **changes}))
        writer.finish()
    return path


def test_a_recording_of_another_major_version_is_refused_with_the_versions(recorded, tmp_path):
    path = with_manifest(recorded, tmp_path / "newer.mcap", contract="3.1")
    with pytest.raises(TouchlineError, match=r"version 3\.1, this program reads 2\.0"):
        open_recording(path)


def test_a_manifest_that_began_at_no_time_is_damaged(recorded, tmp_path):
    path = with_manifest(recorded, tmp_path / "forged.mcap", started="yesterday")
    with pytest.raises(TouchlineError, match=r"damaged: Invalid isoformat string: 'yesterday'"):
        open_recording(path)


def test_what_a_later_version_added_to_the_manifest_is_passed_over(recorded, tmp_path):
    path = with_manifest(recorded, tmp_path / "newer.mcap", weather="rain", attached="{}")
    assert open_recording(path).manifest == recorded.manifest.replace(attached={})
