"""Files that were cut off, damaged, or left by a killed recorder: what is whole is there, nothing is made up."""

import random
from itertools import product
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap.stream_reader import StreamReader
from mcap.writer import CompressionType, Writer

from recordings.editing.filtering import filter_recording
from recordings.editing.recovery import recover
from recordings.inspection.recording_facts import facts_of
from recordings.reading.cursor import Cursor
from recordings.reading.recording import open_recording
from schemas.errors import TouchlineError

TIMES = 100


@pytest.fixture(scope="module")
def rng() -> random.Random:
    return random.Random(7)


@pytest.fixture(scope="module")
def finished() -> dict[str, bytes]:
    """What `several_chunks` has recorded once for all tests."""
    return {}


@pytest.fixture
def several_chunks(make_rig, finished, tmp_path) -> Path:
    """A finished recording of 208 ticks in 16 chunks."""
    path = tmp_path / "match.mcap"
    if finished:
        path.write_bytes(finished["match"])
        return path
    rig = make_rig(path=path)
    rig.begin()
    clock = rig.recorder_bus.clock
    for tick in range(208):
        rig.host.play(tick)
        clock.sleep_until(clock.now() + 0.02)
        rig.recorder.pump()
        if tick % 13 == 12:
            rig.sink.sync()  # ends a chunk, however busy the machine is
    rig.host.bus.clock.sim_ns += 20_000_000  # no two chunks share a log time
    rig.host.goal(208)
    rig.leave()
    finished["match"] = path.read_bytes()
    return path


def told(path: Path) -> list[tuple[str, int, int, bytes]]:
    return [(m.key, m.sequence, m.log_ns, m.payload) for m in open_recording(path).messages()]


def check_with_the_stock_readers(path: Path) -> int:
    """Indexed and as a stream, with checksums; returns how many messages both find, those for viewers left out."""
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        encodings = [channel.message_encoding for _, channel, _ in reader.iter_messages()]
        by_index = len(encodings)
        statistics = reader.get_summary().statistics
        assert statistics.message_count == by_index == sum(statistics.channel_message_counts.values())
        assert statistics.chunk_count == len(reader.get_summary().chunk_indexes)
        list(reader.iter_attachments())
        file.seek(0)
        records = list(StreamReader(file, validate_crcs=True).records)
    assert sum(type(record).__name__ == "Message" for record in records) == by_index
    return encodings.count("json")


def test_a_file_that_is_whole_is_left_as_it_is(several_chunks):
    before = several_chunks.read_bytes()
    done = recover(several_chunks)
    assert (done.repaired, done.messages, done.cut) == (False, 1249, 0)
    assert several_chunks.read_bytes() == before


def test_a_file_that_was_left_becomes_a_whole_recording(make_rig):
    rig = make_rig()
    rig.begin()
    rig.play(range(100))
    rig.sink.sync()
    rig.sink.abandon()
    before = told(rig.path)

    done = recover(rig.path)
    assert (done.path, done.repaired, done.damaged, done.original) == (rig.path, True, 0, None)
    assert told(rig.path) == before
    assert check_with_the_stock_readers(rig.path) == len(before) == done.messages
    facts = facts_of(open_recording(rig.path, whole=True))
    assert (facts.ended, facts.lost, facts.complete) == ("cut_off", 0, True)


@pytest.mark.slow
def test_a_file_truncated_anywhere_has_an_exact_beginning_or_is_reported_as_empty(several_chunks, tmp_path, rng):
    data, whole = several_chunks.read_bytes(), told(several_chunks)
    path = tmp_path / "cut.mcap"
    lengths = []
    for number in range(TIMES):
        size = rng.randrange(len(data))
        path.write_bytes(data[:size] + bytes(4096 if number % 4 == 0 else 0))
        try:
            open_recording(path)
            readable = told(path)
            done = recover(path)
        except TouchlineError as error:
            assert "\n" not in str(error)
            assert size < 120_000
            continue
        rest = told(path)
        assert rest == whole[: len(rest)]
        assert rest[: len(readable)] == readable
        assert check_with_the_stock_readers(path) == len(rest) == done.messages
        assert open_recording(path, whole=True).manifest == open_recording(several_chunks).manifest
        lengths.append(len(rest))
    assert len(lengths) > TIMES / 4
    assert len({*lengths}) > 12


def test_all_whole_chunks_before_the_cut_are_there(several_chunks, tmp_path):
    """Cut in the middle of each chunk, and of the indexes behind it: the chunks before it stay, and it itself too."""
    data, whole = several_chunks.read_bytes(), told(several_chunks)
    with several_chunks.open("rb") as file:
        chunks = make_reader(file).get_summary().chunk_indexes
    counts = [0, *(sum(entry[2] <= chunk.message_end_time for entry in whole) for chunk in chunks)]
    path = tmp_path / "cut.mcap"
    for number, chunk in [*enumerate(chunks)][::5]:
        end = chunk.chunk_start_offset + chunk.chunk_length
        for size, found in ((end - 1, counts[number]), (end, counts[number + 1]), (end + 20, counts[number + 1])):
            path.write_bytes(data[:size])
            assert recover(path).messages == found
            assert told(path) == whole[:found]
            check_with_the_stock_readers(path)


@pytest.mark.parametrize("times", [pytest.param(30, marks=pytest.mark.slow), pytest.param(200, marks=pytest.mark.long)])
def test_a_flipped_bit_is_reported_or_does_no_harm(several_chunks, tmp_path, rng, times):
    """Never a traceback, never data that is silently wrong: reading gives the truth, a part of it, or one sentence."""
    data, whole = several_chunks.read_bytes(), told(several_chunks)
    manifest = open_recording(several_chunks).manifest
    attachments = open_recording(several_chunks).attachments
    path, truth = tmp_path / "flipped.mcap", {*whole}
    sentences = harmless = 0
    for _ in range(times):
        changed = bytearray(data)
        at = rng.randrange(len(data))
        changed[at] ^= 1 << rng.randrange(8)
        path.write_bytes(changed)
        try:
            recording = open_recording(path)
            assert recording.manifest == manifest
            assert all(attachments[name] == content for name, content in recording.attachments.items())
            rest = told(path)
            assert rest == whole or not recording.complete
            assert truth.issuperset(rest)
            facts_of(recording)
            harmless += 1
        except TouchlineError as error:
            assert "\n" not in str(error)
            assert str(path) in str(error)
            sentences += 1
        try:
            recover(path)
            kept = told(path)
        except TouchlineError as error:
            assert "\n" not in str(error)
            continue
        entries = iter(whole)
        assert all(entry in entries for entry in kept)  # in order, nothing made up
        check_with_the_stock_readers(path)
    assert sentences > times / 10
    assert harmless > times / 10


def test_a_complete_match_that_lost_a_chunk_is_still_complete(recorded):
    with recorded.path.open("rb") as file:
        chunk = make_reader(file).get_summary().chunk_indexes[0]
    data = bytearray(recorded.path.read_bytes())
    data[chunk.chunk_start_offset + chunk.chunk_length // 2] ^= 4
    recorded.path.write_bytes(data)
    recover(recorded.path)

    facts, before = facts_of(open_recording(recorded.path, whole=True)), recorded.result
    assert (facts.ended, facts.phase, facts.score) == ("full_time", "full_time", {"cyan": 1, "magenta": 0})
    assert facts.messages < before.messages
    assert facts.messages == len(told(recorded.path))
    check_with_the_stock_readers(recorded.path)


def test_a_damaged_chunk_is_left_out_the_rest_stays_and_nothing_is_left_to_repair(several_chunks):
    whole = told(several_chunks)
    with several_chunks.open("rb") as file:
        chunk = make_reader(file).get_summary().chunk_indexes[5]
    data = bytearray(several_chunks.read_bytes())
    data[chunk.chunk_start_offset + chunk.chunk_length // 2] ^= 4
    several_chunks.write_bytes(data)
    with pytest.raises(TouchlineError, match=r"damaged inside.*touchline recover"):
        told(several_chunks)

    done = recover(several_chunks)
    assert (done.repaired, done.damaged, done.cut) == (True, 1, 0)
    gone = [entry for entry in whole if chunk.message_start_time <= entry[2] <= chunk.message_end_time]
    assert told(several_chunks) == [entry for entry in whole if entry not in gone]
    assert facts_of(open_recording(several_chunks)).lost == len(gone)
    check_with_the_stock_readers(several_chunks)
    repaired = several_chunks.read_bytes()
    assert not recover(several_chunks).repaired
    assert several_chunks.read_bytes() == repaired


def test_a_second_repair_and_a_copy_still_tell_what_the_first_repair_has_left_out(several_chunks, tmp_path):
    for left_out in (1, 2):
        with several_chunks.open("rb") as file:
            summary = make_reader(file).get_summary()
        (result,) = [one for one in summary.metadata_indexes if one.name == "result"]
        data = bytearray(several_chunks.read_bytes())
        data[summary.chunk_indexes[5].chunk_start_offset + 200 if left_out == 1 else result.offset + 50] ^= 4
        several_chunks.write_bytes(data)
        assert recover(several_chunks).damaged == 1
        repaired = open_recording(several_chunks)
        filter_recording(repaired, tmp_path / "copy.mcap")
        assert repaired.damaged_records == open_recording(tmp_path / "copy.mcap").damaged_records == left_out


def change(path: Path, old: bytes, new: bytes) -> None:
    """Change bytes that stand in the file once, and keep their number."""
    content = path.read_bytes()
    assert content.count(old) == 1 and len(old) == len(new)
    path.write_bytes(content.replace(old, new))


def test_a_result_that_has_changed_is_left_out(recorded):
    before = told(recorded.path)
    with recorded.path.open("rb") as file:
        (result,) = [one for one in make_reader(file).get_summary().metadata_indexes if one.name == "result"]
    content = bytearray(recorded.path.read_bytes())
    at = content.index(b'"cyan":1', result.offset)
    assert at < result.offset + result.length
    content[at + 7] = ord("9")
    recorded.path.write_bytes(content)

    done = recover(recorded.path)
    assert (done.repaired, done.damaged) == (True, 1)
    recording = open_recording(recorded.path, whole=True)
    assert (recording.result, recording.damaged_records) == (None, 1)
    assert facts_of(recording).score == {"cyan": 1, "magenta": 0}, "from the game states"
    assert told(recorded.path) == before
    check_with_the_stock_readers(recorded.path)


def test_an_attachment_that_has_changed_is_left_out_and_named(recorded):
    name, content = next(iter(recorded.attachments.items()))
    change(recorded.path, content, content[:-1] + bytes([content[-1] ^ 1]))
    assert recover(recorded.path).damaged == 1
    recording = open_recording(recorded.path, whole=True)
    assert recording.damaged == [name] and name not in recording.attachments
    check_with_the_stock_readers(recorded.path)


def test_times_of_a_chunk_that_have_changed_are_put_right(several_chunks):
    """No checksum covers them, and readers skip chunks by them."""
    whole, data = told(several_chunks), bytearray(several_chunks.read_bytes())
    with several_chunks.open("rb") as file:
        summary = make_reader(file).get_summary()
    chunk = summary.chunk_indexes[5]
    data[chunk.chunk_start_offset + 9 + 3] ^= 0x40
    several_chunks.write_bytes(data)

    recover(several_chunks)
    assert told(several_chunks) == whole
    cursor = Cursor(several_chunks)
    cursor.seek(chunk.message_start_time)
    assert cursor.peek().log_ns == chunk.message_start_time
    check_with_the_stock_readers(several_chunks)


def test_a_chunk_whose_schema_is_lost_is_left_out(tmp_path):
    """Without a summary, a schema stands only in the chunk that introduced it; stock readers need it by the index."""
    path = tmp_path / "match.mcap"
    with path.open("wb") as file:
        writer = Writer(file, compression=CompressionType.NONE)
        writer.start()
        writer.add_metadata("note", {"text": "whole"})
        schema = writer.register_schema("touchline.Command", "jsonschema", b"{}")
        for number in range(3):
            channel = writer.register_channel(f"robot/cyan{number}/command", "json", schema)
            writer.add_message(channel, number, b"content %d" % number, number)
            writer.flush()
        end = file.tell()
        writer.finish()
    content = bytearray(path.read_bytes()[:end])
    content[content.index(b"content 0")] ^= 1
    path.write_bytes(content)

    done = recover(path)
    assert (done.messages, done.damaged) == (0, 3)
    assert check_with_the_stock_readers(path) == 0


@pytest.mark.parametrize(
    ("what", "bit"), [*product(("chunk", "index"), range(8)), *product(("metadata",), (0, 1, 2, 3, 7))]
)
def test_a_record_whose_opcode_changed_is_left_out_and_the_rest_stays(several_chunks, bit, what):
    """One bit makes a footer of a chunk, an end of all data of an index, a channel of metadata."""
    whole = told(several_chunks)
    with several_chunks.open("rb") as file:
        summary = make_reader(file).get_summary()
    chunk = summary.chunk_indexes[5]
    index = min(chunk.message_index_offsets.values())
    place = {"chunk": chunk.chunk_start_offset, "index": index, "metadata": summary.metadata_indexes[-1].offset}[what]
    data = bytearray(several_chunks.read_bytes())
    data[place] ^= 1 << bit
    several_chunks.write_bytes(data)

    done = recover(several_chunks)
    assert (done.repaired, done.cut) == (True, 0)
    lost = [entry for entry in whole if chunk.message_start_time <= entry[2] <= chunk.message_end_time]
    kept = told(several_chunks)
    assert kept == (whole if what != "chunk" else [entry for entry in whole if entry not in lost])
    assert check_with_the_stock_readers(several_chunks) == len(kept)


def test_a_file_of_which_more_than_a_chunk_is_left_out_is_kept_beside_its_repair(several_chunks, tmp_path):
    """A head that was damaged in a file without a summary hides all behind it; a repair must not destroy that."""
    with several_chunks.open("rb") as file:
        chunk = make_reader(file).get_summary().chunk_indexes[3]
    data = bytearray(several_chunks.read_bytes()[: chunk.chunk_start_offset + 100])
    data[chunk.chunk_start_offset + 5] ^= 0x40
    content = bytes(data) + random.Random(1).randbytes(300_000)
    path = tmp_path / "cut.mcap"
    path.write_bytes(content)
    done = recover(path)
    assert done.original == tmp_path / "cut.mcap.damaged"
    assert done.original.read_bytes() == content


def test_a_damaged_file_of_an_earlier_repair_is_never_overwritten(several_chunks):
    earlier = several_chunks.with_name(several_chunks.name + ".damaged")
    earlier.write_bytes(b"of an earlier repair")
    taken = several_chunks.with_name(several_chunks.name + ".damaged-2")
    taken.write_bytes(b"of another one")
    with several_chunks.open("rb") as file:
        chunk = make_reader(file).get_summary().chunk_indexes[1]
    data = bytearray(several_chunks.read_bytes())
    data[chunk.chunk_start_offset + 100] ^= 1
    several_chunks.write_bytes(data)

    done = recover(several_chunks)
    assert done.original == several_chunks.with_name(several_chunks.name + ".damaged-3")
    assert done.original.read_bytes() == bytes(data)
    assert (earlier.read_bytes(), taken.read_bytes()) == (b"of an earlier repair", b"of another one")


@pytest.mark.parametrize("content", [b"", b"tick,x,y\n1,2,3\n", b"\x89MCAP0\r\n", b"\x89MCAP0\r\n" + bytes(5000)])
def test_what_is_no_recording_cannot_be_recovered(tmp_path, content):
    path = tmp_path / "table.mcap"
    path.write_bytes(content)
    with pytest.raises(TouchlineError, match=r"not a recording|nothing in it can be recovered"):
        recover(path)
    assert path.read_bytes() == content
