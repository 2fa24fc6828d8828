"""`touchline info`, `filter`, `diff` and `recover` on files that this project did not write."""

import json
import os
import struct
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap.writer import CompressionType, IndexType, Writer
from typer.testing import CliRunner, Result

from recordings.reading.log_order import open_log
from recordings.recorder.key_counts import KeyCounts
from support.foreign import START_NS, drive, write_mcap
from touchline.commands.cli.command_line import app

WRITERS = {
    "lz4": {},
    "zstd with checksums": {"compression": CompressionType.ZSTD, "enable_data_crcs": True},
    "uncompressed": {"compression": CompressionType.NONE},
    "without chunks": {"use_chunking": False},
    "without indexes": {"index_types": IndexType.NONE},
    "without statistics": {"use_statistics": False},
    "small chunks": {"chunk_size": 200},
    "without channels in the summary": {"repeat_channels": False},
    "without schemas in the summary": {"repeat_schemas": False},
}
every_writer = pytest.mark.parametrize("options", WRITERS.values(), ids=WRITERS)


def touchline(*words: str | Path) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words], prog_name="touchline")


def read(path: Path) -> list[tuple[str, bytes, int]]:
    with path.open("rb") as file:
        return [(channel.topic, one.data, one.log_time) for _, channel, one in make_reader(file).iter_messages()]


@every_writer
def test_info_lists_the_channels_of_any_file(tmp_path, options):
    file = write_mcap(tmp_path / "log.mcap", [*drive(51), *drive(11, "robot2", 50)], **options)
    result = touchline("info", file, "--json")
    assert result.exit_code == 0, result.output
    facts = json.loads(result.output)
    assert (facts["started"], facts["duration"]) == ("2023-11-14T22:13:20.000+00:00", 0.5)
    assert (facts["messages"], facts["lost"], facts["complete"]) == (62, None, True)
    one, other = facts["channels"]
    assert (one["topic"], one["encoding"], one["schema"], one["messages"]) == ("/robot1/odom", "json", "any", 51)
    assert (other["topic"], other["start"], other["end"]) == ("/robot2/odom", 0.0, 0.5)
    table = touchline("info", file).output
    assert "/robot1/odom" in table and "100.0" in table


@pytest.mark.parametrize("order", [(4, 5, 0, 3, 1, 2), (0, 1, 4, 5, 2, 3)])
def test_no_message_is_lost_where_chunks_are_out_of_order(tmp_path, order):
    file = write_mcap(tmp_path / "log.mcap", [("odom", place, bytes(60)) for place in order], chunk_size=150)
    facts = json.loads(touchline("info", file, "--json").output)
    assert touchline("filter", file, "--out", tmp_path / "copy.mcap").exit_code == 0
    copied = [(time - START_NS) / 1e6 for _, _, time in read(tmp_path / "copy.mcap")]
    assert (facts["messages"], facts["duration"], copied) == (6, 0.005, [0, 1, 2, 3, 4, 5])


def test_a_place_that_no_file_has_is_damage(tmp_path):
    file = write_mcap(tmp_path / "log.mcap", drive(), enable_crcs=False)
    with file.open("rb") as content:
        (chunk,) = make_reader(content).get_summary().chunk_indexes
    index = struct.Struct("<QQQ")
    times = chunk.message_start_time, chunk.message_end_time
    before, after = (index.pack(*times, place) for place in (chunk.chunk_start_offset, 1 << 62))
    file.write_bytes(file.read_bytes().replace(before, after))
    result = touchline("diff", file, file)
    assert result.exit_code == 2 and "damaged inside" in result.stderr


@pytest.mark.parametrize("compression", CompressionType, ids=lambda one: one.name.lower())
def test_a_chunk_of_one_large_image_is_read(tmp_path, compression):
    image = os.urandom(40 * 2**20)
    file = write_mcap(tmp_path / "log.mcap", [("image", 0, image)], compression=compression)
    assert json.loads(touchline("info", file, "--json").output)["messages"] == 1
    (message,) = open_log([file]).messages()
    assert message.payload == image


def test_info_adds_up_several_files_and_a_bag_folder(tmp_path):
    bag = tmp_path / "bag"
    bag.mkdir()
    write_mcap(bag / "bag_0.mcap", drive(10))
    write_mcap(bag / "bag_1.mcap", drive(10), start_ns=START_NS + 1_000_000_000)
    other = write_mcap(tmp_path / "other.mcap", drive(5, "robot2"))
    facts = json.loads(touchline("info", bag, other, "--json").output)
    assert [(one["topic"], one["messages"]) for one in facts["channels"]] == [("/robot1/odom", 20), ("/robot2/odom", 5)]
    assert facts["duration"] == pytest.approx(1.09)
    result = touchline("info", tmp_path)
    assert result.exit_code == 0
    empty = tmp_path / "empty"
    empty.mkdir()
    assert "has no *.mcap" in touchline("info", empty).output
    (bag / "metadata.yaml").write_text("rosbag2_bagfile_information:\n  compression_mode: MESSAGE\n")
    assert "each message is compressed" in touchline("info", bag).output


@every_writer
def test_filter_copies_a_part_of_any_file_by_key_and_time(tmp_path, options):
    file = write_mcap(tmp_path / "log.mcap", [*drive(50), *drive(50, "robot2")], **options)
    out = tmp_path / "part.mcap"
    result = touchline("filter", file, "--out", out, "--include", "robot1/*", "--from", "0.1", "--to", "0.2")
    assert result.exit_code == 0, result.output
    expected = [(topic, payload, START_NS + ms * 1_000_000) for topic, ms, payload in drive(20)[10:]]
    assert read(out) == expected
    with out.open("rb") as copy:
        schema, channel, _ = next(make_reader(copy).iter_messages())
    assert (schema.name, channel.metadata) == ("any", {"by": "them"})


def test_filter_makes_one_file_of_several_and_of_a_bag_folder_in_the_order_of_log_times(tmp_path):
    bag = tmp_path / "bag"
    bag.mkdir()
    write_mcap(bag / "bag_0.mcap", drive(10))
    write_mcap(bag / "bag_1.mcap", drive(10), start_ns=START_NS + 1_000_000_000)
    other, out = write_mcap(tmp_path / "other.mcap", drive(40, "robot2", 7)), tmp_path / "all.mcap"
    assert "all.mcap: 60 messages" in touchline("filter", bag, other, "--out", out).output
    times = [log_ns for _, _, log_ns in read(out)]
    assert len(times) == 60 and times == sorted(times)
    assert [payload for topic, payload, _ in read(out) if "robot2" in topic] == [
        one for _, _, one in drive(40, "robot2")
    ]
    for taken in (bag / "bag_1.mcap", out):  # another recording is no less dear than the one that is read
        assert f"{taken}: already exists; name another" in touchline("filter", bag, "--out", taken).output


def test_a_file_made_of_several_recordings_of_keys_has_the_counts_of_all(tmp_path):
    def recorded(name: str, *counts: KeyCounts) -> Path:
        path = tmp_path / f"{name}.mcap"
        with path.open("wb") as file:
            writer = Writer(file)
            writer.start()
            channel = writer.register_channel("robot1/odom", "json", 0, {"zenoh_encoding": "application/json"})
            writer.add_message(channel, START_NS, b"{}", START_NS)
            for one in counts:
                writer.add_metadata("keys", one.metadata())
            writer.finish()
        return path

    one = recorded("one", KeyCounts("robot1/**", {"robot1/odom": 3}, 0))
    other = recorded("other", KeyCounts("robot1/** robot2/**", {"robot1/odom": 4, "robot2/odom": 1}, 7))
    whole = tmp_path / "whole.mcap"
    for files in ((one, other), (whole,)):
        facts = json.loads(touchline("info", *files, "--json").output)
        assert (facts["lost"], facts["unwritten"], facts["ended"]) == (8, 7, None)
        assert [channel["lost"] for channel in facts["channels"]] == [7]
        if not whole.exists():
            assert touchline("filter", one, other, "--out", whole).exit_code == 0
    assert touchline("filter", one, recorded("killed"), "--out", tmp_path / "cut.mcap").exit_code == 0
    facts = json.loads(touchline("info", tmp_path / "cut.mcap", "--json").output)
    assert (facts["lost"], facts["ended"]) == (None, "cut_off")


@every_writer
def test_diff_compares_any_files_by_key_whatever_their_times(tmp_path, options):
    one = write_mcap(tmp_path / "one.mcap", [*drive(50), *drive(50, "robot2")], **options)
    other = write_mcap(tmp_path / "other.mcap", [*drive(50, "robot2", 7), *drive(50, step=9)], start_ns=5)
    assert touchline("diff", one, other).output == "identical: 100 messages on 2 keys\n"


def test_diff_names_the_first_message_that_differs_or_is_missing(tmp_path):
    changed = drive(50)
    changed[20] = ("/robot1/odom", 200, b'{"x": 7.5}')
    one, other = write_mcap(tmp_path / "one.mcap", drive(50)), write_mcap(tmp_path / "other.mcap", changed)
    result = touchline("diff", one, other)
    assert result.exit_code == 1
    assert "robot1/odom, message 20 at 0.200 s" in result.output
    assert "x: 2.0 – 7.5" in result.output
    short = write_mcap(tmp_path / "short.mcap", drive(49))
    assert f"message 49 at 0.490 s is missing in {short}" in touchline("diff", one, short).output
    raw = {"encoding": "raw", "schema": None}
    ours = write_mcap(tmp_path / "ours.mcap", [("image", 0, b"\x00" * 1000)], **raw)
    theirs = write_mcap(tmp_path / "theirs.mcap", [("image", 0, b"\x00" * 500 + b"\x01")], **raw)
    assert "byte 500: '00 00 00 00 00 00 00 00 of 1000' – '01 of 501'" in touchline("diff", ours, theirs).output


@every_writer
def test_recover_leaves_an_intact_file_of_any_writer_as_it_is(tmp_path, options):
    file = write_mcap(tmp_path / "log.mcap", drive(50), **options)
    before = file.read_bytes()
    result = touchline("recover", file)
    assert result.exit_code == 0, result.output
    assert sum(1 for _ in open_log([file]).messages()) == 50
    if options.get("use_statistics", True):  # else it gets its statistics
        assert "intact, 50 messages" in result.output
        assert file.read_bytes() == before


@every_writer
def test_recover_repairs_a_truncated_file_of_any_writer(tmp_path, options):
    file = write_mcap(tmp_path / "log.mcap", drive(2000), **{"chunk_size": 10_000, **options})
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    result = touchline("recover", file)
    assert result.exit_code == 0, result.output
    rest = [payload for _, payload, _ in read(file)]
    assert len(rest) > (0 if options.get("chunk_size") else 300)
    assert rest == [payload for _, _, payload in drive(len(rest))]
