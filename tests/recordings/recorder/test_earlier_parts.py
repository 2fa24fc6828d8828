"""A recorder that is killed, and its successor, which begins the next part with what the host still keeps."""

import random
from collections.abc import Callable
from pathlib import Path

import pytest

from recordings.container.manifest import EndReason
from recordings.inspection.contradictions import record_faults
from recordings.inspection.recording_facts import facts_of
from recordings.reading.cursor import Cursor
from recordings.reading.recording import Recording, open_recording
from recordings.recorder.earlier_parts import read_earlier_parts
from recordings.recorder.part_sink import PartSink
from recordings.recorder.recorder import Recorder
from schemas.config.settings import RecordOptions
from schemas.errors import TouchlineError
from schemas.recovery_window import KEPT_BATCHES
from schemas.soccer.game import Phase, Score
from schemas.topics import COMMAND
from support.recorder_rig import ONE_PART, RecorderRig

TICKS = 60
INSTANTS = 20
Wait = Callable[[RecorderRig], None]


def read(recording: Recording) -> list[tuple[str, int, int, int, bytes]]:
    return [(one.key, one.sequence, one.log_ns, one.sent_ns, one.payload) for one in recording.messages()]


def kill(rig: RecorderRig, wait: Wait, flushed: float = 1.0) -> None:
    """What SIGKILL leaves: a part of what was written, and nothing of what was not."""
    wait(rig)
    part = rig.sink.files[-1]
    content = part.read_bytes()
    rig.recorder_bus.close()
    rig.sink.abandon()
    part.write_bytes(content[: round(flushed * len(content))])


def relaunch(rig: RecorderRig, options: RecordOptions = ONE_PART) -> None:
    """The successor takes the killed recorder's place in the rig."""
    bus = rig.host.bus.shared_state.open_bus("friendly", rig.recorder_bus.clock)
    earlier = read_earlier_parts(rig.path, host=0)
    rig.recorder_bus, rig.sink = bus, PartSink(rig.path, bus.clock, options, earlier)
    rig.recorder = Recorder(bus, rig.sink, earlier=earlier)
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

    def begin(path: Path | None = None, options: RecordOptions = ONE_PART) -> RecorderRig:
        rig = make_rig(path=path, options=options)
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
        relaunch(rig)
        play_to_the_end(rig)
        recording = open_recording(rig.path, whole=True)
        assert read(recording) == whole
        result = recording.result
        assert (result.ended, result.lost, result.messages) == (EndReason.FULL_TIME, 0, len(whole))
        assert result.keys == undisturbed.read().result.keys
        assert facts_of(recording).contradictions == record_faults(recording) == []
        assert sorted(file.name for file in folder.iterdir()) == ["match.2.mcap", "match.mcap"]


def test_a_recorder_that_is_killed_again_and_again_has_a_part_each_time(
    begun: Callable[..., RecorderRig], wait_until_written: Wait
) -> None:
    rig = begun()
    for _ in range(4):
        play(rig, 8)
        kill(rig, wait_until_written, 0.95)
        play_unrecorded(rig, 3)
        relaunch(rig)
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
    relaunch(rig)
    play_to_the_end(rig, rig.played + 5)
    worlds = [world.tick for _, world in rig.read().decoded("world")]
    missing = [tick for tick in range(rig.played) if tick not in worlds]
    assert missing == list(range(19, 19 + len(missing)))  # 19, the last tick of the killed part, may be incomplete
    assert 51 <= len(missing) <= 53
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
    relaunch(rig)
    play_to_the_end(rig)
    payloads = [one.payload for one in rig.read().messages(stranger) if not one.payload.startswith(b"{")]
    assert payloads == [b"forward", b"forward", b"back"]


@pytest.mark.parametrize("flushed", [1.0, 0.7, 0.0])
def test_a_recording_of_several_parts_goes_on_after_its_last_one(
    begun: Callable[..., RecorderRig], wait_until_written: Wait, flushed: float
) -> None:
    options = RecordOptions(part_duration=0.5)
    rig = begun(options=options)
    play(rig, 40)
    kill(rig, wait_until_written, flushed)
    play_unrecorded(rig, 2)
    relaunch(rig, options)
    play_to_the_end(rig, 90)
    recording = open_recording(rig.path, whole=True)
    assert [world.tick for _, world in recording.decoded("world")] == list(range(90))
    assert recording.result.keys["world"].messages == 90
    assert (recording.result.lost, recording.result.missed_before_start) == (0, 0)
    cursor, worlds = Cursor(rig.path), []
    while (message := cursor.peek()) is not None:
        worlds += [message.message().tick] if message.key == "world" else []
        cursor.skip()
    assert worlds == list(range(90))


def test_a_recording_of_another_match_is_not_continued(rig: RecorderRig) -> None:
    """As when two matches were told to write one file, and the other one's recorder has ended."""
    rig.play(range(10))
    rig.leave()
    before = rig.path.read_bytes()
    with pytest.raises(TouchlineError, match=r"match\.mcap: is a recording of another match; name another file"):
        read_earlier_parts(rig.path, host=1)
    assert rig.path.read_bytes() == before


@pytest.mark.parametrize("content", [b"", b"\x89MCAP0"])
def test_a_part_that_its_recorder_has_not_begun_is_passed_over(
    make_rig: Callable[..., RecorderRig], tmp_path: Path, content: bytes
) -> None:
    path = tmp_path / "match.mcap"
    path.write_bytes(content)
    rig = make_rig(path=tmp_path / "other.mcap")
    rig.path = path
    play_unrecorded(rig, 20)
    rig.recorder_bus.close()
    rig.sink.abandon()
    relaunch(rig)
    play_to_the_end(rig)
    assert [world.tick for _, world in rig.read().decoded("world")] == list(range(TICKS))


def test_what_is_no_recording_is_not_continued(tmp_path: Path) -> None:
    (tmp_path / "match.mcap").write_bytes(b"not a recording")
    with pytest.raises(TouchlineError, match="not a recording"):
        read_earlier_parts(tmp_path / "match.mcap", host=0)


def test_a_folder_in_place_of_an_earlier_part_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match=r"Is a directory; name another file, or move that one away"):
        read_earlier_parts(tmp_path, host=0)
