"""A recorder that is killed, and its successor, which continues its file with what the host still keeps."""

import random
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap.stream_reader import StreamReader

from recordings.container import repair
from recordings.container.manifest import EndReason
from recordings.container.numbering import numbered_files
from recordings.inspection.recording_facts import facts_of
from recordings.reading.recording import Recording, open_recording
from recordings.reading.split_cursor import SplitCursor
from recordings.recorder.file_limits import ONE_FILE, FileLimits
from recordings.recorder.leftover import find_leftover
from recordings.recorder.recorder import Recorder
from recordings.recorder.sink import FileSink
from schemas.errors import TouchlineError
from schemas.game import Phase, Score
from schemas.recovery_window import KEPT_BATCHES
from schemas.topics import COMMAND
from support.recorder_rig import RecorderRig

TICKS = 60
INSTANTS = 60
Wait = Callable[[RecorderRig], None]


def read(recording: Recording) -> list[tuple[str, int, int, int, bytes]]:
    return [(one.key, one.sequence, one.log_ns, one.sent_ns, one.payload) for one in recording.messages()]


def kill(rig: RecorderRig, wait: Wait, flushed: float = 1.0) -> None:
    """What SIGKILL leaves: a part of what was written, and nothing of what was not."""
    wait(rig)
    part = next(rig.path.parent.glob("*.part"))
    content = part.read_bytes()
    rig.recorder_bus.close()
    rig.sink.abandon()
    part.write_bytes(content[: round(flushed * len(content))])


def resume(rig: RecorderRig, limits: FileLimits = ONE_FILE) -> None:
    """The successor takes the killed recorder's place in the rig."""
    bus = rig.host.bus.shared_state.open_bus("friendly", rig.recorder_bus.clock)
    leftover = find_leftover(rig.path, limits)
    sink = FileSink(rig.path, bus.clock, "friendly", leftover.loss_counts, limits, leftover=leftover)
    rig.recorder_bus, rig.sink = bus, sink
    rig.recorder = Recorder(bus, sink, leftover.loss_counts, leftover=leftover)
    rig.begin()
    catch_up(rig)


def catch_up(rig: RecorderRig) -> None:
    for _ in range(20):
        rig.recorder.pump()
        rig.host.answer()
        rig.recorder_bus.clock.sleep_until(rig.recorder_bus.clock.now() + 0.3)


@pytest.fixture
def begun(make_rig: Callable[..., RecorderRig]) -> Callable[..., RecorderRig]:
    """A rig whose recorder has begun; `played` is the next tick."""

    def begin(path: Path | None = None, limits: FileLimits = ONE_FILE) -> RecorderRig:
        rig = make_rig(path=path, limits=limits)
        rig.begin()
        return rig

    return begin


def play(rig: RecorderRig, ticks: int) -> None:
    rig.play(range(rig.played, rig.played + ticks))
    rig.played += ticks


def play_unrecorded(rig: RecorderRig, ticks: int) -> None:
    """While there is no recorder."""
    for _ in range(ticks):
        rig.host.play(rig.played)
        rig.played += 1


def play_to_the_end(rig: RecorderRig, ticks: int = TICKS) -> None:
    play(rig, ticks - rig.played)
    rig.host.referee(ticks - 1, Phase.FULL_TIME, Score(cyan=1))
    rig.leave()


def check_with_the_stock_readers(path: Path) -> None:
    """By index and as a stream, with checksums."""
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        count = sum(1 for _ in reader.iter_messages())
        summary = reader.get_summary()
        assert summary.statistics.message_count == count == sum(summary.statistics.channel_message_counts.values())
        file.seek(0)
        records = [type(record).__name__ for record in StreamReader(file, validate_crcs=True).records]
    assert records.count("Message") == count


def test_a_recorder_killed_at_any_instant_leaves_its_successor_a_whole_recording(
    begun: Callable[..., RecorderRig], wait_until_written: Wait, tmp_path: Path
) -> None:
    undisturbed = begun(tmp_path / "undisturbed.mcap")
    play_to_the_end(undisturbed)
    whole = read(undisturbed.read())
    instants = random.Random(14)
    for number in range(INSTANTS):
        folder = tmp_path / str(number)
        rig = begun(folder / "match.mcap")
        for _ in range(instants.randrange(1, 4)):
            play(rig, instants.randrange(1, 15))
            rig.sink.sync()
        kill(rig, wait_until_written, instants.random())
        play_unrecorded(rig, instants.randrange(0, 10))
        resume(rig)
        play_to_the_end(rig)
        recording = open_recording(rig.path, whole=True)
        assert read(recording) == whole
        result = recording.result
        assert (result.ended, result.lost, result.messages) == (EndReason.FULL_TIME, 0, len(whole))
        assert result.keys == undisturbed.read().result.keys
        check_with_the_stock_readers(rig.path)
        assert [file.name for file in folder.iterdir()] == ["match.mcap"]


def test_a_recorder_that_is_killed_again_and_again_is_continued_each_time(
    begun: Callable[..., RecorderRig], wait_until_written: Wait
) -> None:
    rig = begun()
    for _ in range(4):
        play(rig, 8)
        kill(rig, wait_until_written, 0.95)
        play_unrecorded(rig, 3)
        resume(rig)
    play_to_the_end(rig)
    worlds = [world.tick for _, world in rig.read().decoded("world")]
    assert worlds == list(range(TICKS))
    assert rig.read().result.lost == 0


def test_what_the_host_no_longer_keeps_is_counted_as_lost(
    begun: Callable[..., RecorderRig], wait_until_written: Wait
) -> None:
    rig = begun()
    play(rig, 20)
    rig.recorder.pump()
    kill(rig, wait_until_written)
    play_unrecorded(rig, KEPT_BATCHES + 50)
    resume(rig)
    play_to_the_end(rig, rig.played + 5)
    worlds = [world.tick for _, world in rig.read().decoded("world")]
    missing = [tick for tick in range(rig.played) if tick not in worlds]
    assert missing == list(range(20, 20 + len(missing)))
    assert 50 <= len(missing) <= 52
    assert rig.read().result.keys["world"].lost == len(missing)
    assert facts_of(rig.read()).lost == 6 * len(missing)


def test_a_message_without_a_stamp_is_written_once(begun: Callable[..., RecorderRig], wait_until_written: Wait) -> None:
    rig = begun()
    stranger = rig.host.robots.publisher(COMMAND, robot="cyan1").key
    play(rig, 5)
    for payload in (b"forward", b"forward", b"back"):
        rig.host.add_unstamped(stranger, payload)
    play(rig, 5)
    kill(rig, wait_until_written)
    resume(rig)
    play_to_the_end(rig)
    payloads = [one.payload for one in rig.read().messages(stranger) if not one.payload.startswith(b"{")]
    assert payloads == [b"forward", b"forward", b"back"]


def test_viewers_channels_go_on_with_their_numbers(begun: Callable[..., RecorderRig], wait_until_written: Wait) -> None:
    rig = begun()
    play(rig, 30)
    kill(rig, wait_until_written, 0.9)
    resume(rig)
    play_to_the_end(rig)
    with rig.path.open("rb") as file:
        frames = [message for _, _, message in make_reader(file).iter_messages(topics=["/tf"])]
    assert [frame.sequence for frame in frames] == list(range(len(frames)))
    assert TICKS - 1 <= len(frames) <= TICKS
    assert all(before.log_time <= after.log_time for before, after in pairwise(frames))


@pytest.mark.parametrize("flushed", [1.0, 0.7, 0.0])
def test_a_split_recording_is_continued_in_its_last_file(
    begun: Callable[..., RecorderRig], wait_until_written: Wait, flushed: float
) -> None:
    limits = FileLimits(duration=0.5)
    rig = begun(limits=limits)
    play(rig, 40)
    kill(rig, wait_until_written, flushed)
    play_unrecorded(rig, 2)
    resume(rig, limits)
    play_to_the_end(rig, 90)
    files = numbered_files(rig.path)
    assert [file.name for file in files] == [f"match.{number:04d}.mcap" for number in range(1, len(files) + 1)]
    cursor, worlds = SplitCursor(rig.path), []
    while (message := cursor.peek()) is not None:
        worlds += [message.message().tick] if message.key == "world" else []
        cursor.skip()
    assert worlds == list(range(90))
    results = [open_recording(file, whole=True).result for file in files]
    assert sum(result.keys["world"].messages for result in results) == 90
    assert all(result.lost == 0 for result in results)
    assert all(result.missed_before_start == 0 for result in results)


def test_a_file_that_another_recorder_writes_is_not_continued(begun: Callable[..., RecorderRig]) -> None:
    rig = begun()
    play(rig, 5)
    with pytest.raises(TouchlineError, match="is being written by another recorder"):
        find_leftover(rig.path, ONE_FILE)


def test_a_file_that_cannot_be_cut_is_kept(
    begun: Callable[..., RecorderRig], wait_until_written: Wait, monkeypatch: pytest.MonkeyPatch
) -> None:
    rig = begun()
    for _ in range(4):
        play(rig, 10)
        rig.sink.sync()
    kill(rig, wait_until_written, 0.95)
    part = next(rig.path.parent.glob("*.part"))
    before = part.read_bytes()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(repair, "execute", full)
    with pytest.raises(TouchlineError, match=r"match\.mcap\.part: No space left on device"):
        find_leftover(rig.path, ONE_FILE)
    assert part.read_bytes() == before


def test_what_is_no_recording_is_set_aside(begun: Callable[..., RecorderRig], tmp_path: Path) -> None:
    part = tmp_path / "match.mcap.part"
    part.write_bytes(b"not a recording")
    leftover = find_leftover(tmp_path / "match.mcap", ONE_FILE)
    assert leftover.partial_file is None
    begun(tmp_path / "match.mcap")
    assert part.with_name("match.mcap.part.old").read_bytes() == b"not a recording"
