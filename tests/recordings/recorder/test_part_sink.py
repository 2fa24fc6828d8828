"""The parts that a recorder writes: all of one recording, each readable by itself."""

import pytest

from recordings.container.key_selection import KeySelection
from recordings.container.manifest import EndReason
from recordings.inspection.recording_facts import facts_of
from recordings.reading.recording import open_recording
from schemas.config.settings import RecordOptions
from schemas.errors import TouchlineError
from schemas.soccer.game import Phase, Score


def ticks_in(path) -> list[int]:
    recording = open_recording(path, whole=True)
    return [world.tick for _, world in recording.decoded("world", start=recording.manifest.begins_ns / 1e9)]


def test_keys_that_are_left_out_are_not_in_the_file_and_not_lost(make_rig):
    rig = make_rig(selection=KeySelection(("world", "robot/**"), ("robot/cyan2/*",)))
    rig.begin()
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(50))
    rig.host.referee(49, Phase.FULL_TIME, Score())
    summary = rig.leave()

    keys = [channel.key for channel in rig.read().channels]
    assert keys == ["robot/cyan1/command", "robot/magenta1/command", "robot/magenta2/command", "world"]
    assert rig.read().manifest.include == ["world", "robot/**"]
    assert (summary.result.ended, summary.result.tick, summary.result.lost) == (EndReason.FULL_TIME, 49, 0)


def test_a_recording_continues_in_its_next_part_after_a_duration(make_rig, tmp_path):
    rig = make_rig(options=RecordOptions(part_duration=1.0))
    rig.begin()
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(170))
    files = rig.leave().files

    assert [file.name for file in files] == ["match.mcap", "match.2.mcap", "match.3.mcap", "match.4.mcap"]
    assert ticks_in(rig.path) == list(range(170))
    alone = files[2].rename(tmp_path / "third.mcap")
    assert ticks_in(alone) == list(range(100, 150))
    third = open_recording(alone, whole=True)
    assert third.manifest.setup == rig.host.setup
    assert "message_schemas.json" in third.attachments
    assert (third.manifest.part, third.manifest.begins_ns) == (3, 2_000_000_000)
    assert third.result.ended is EndReason.CONTINUED
    assert [state.tick for _, state in third.decoded("game/state")] == [0]
    repeated = [recorded.key for recorded in third.messages(end=2.0)]
    assert sorted(repeated) == ["game/state", "host/applied", "world"]
    facts = facts_of(third)
    assert (facts.lost, facts.messages, facts.part) == (0, 50 * 6, 3)


def test_a_recording_continues_in_its_next_part_after_a_size(make_rig, wait_until_written):
    rig = make_rig(options=RecordOptions(part_size=0.012))
    rig.begin()
    clock = rig.recorder_bus.clock
    for tick in range(600):
        rig.host.play(tick)
        clock.sleep_until(clock.now() + 0.02)
        rig.recorder.pump()
        if tick % 50 == 49:
            wait_until_written(rig)  # the size is that of the file
    assert len(rig.leave().files) > 1
    assert ticks_in(rig.path) == list(range(600))


def test_a_part_of_another_recording_is_not_written_over(make_rig, tmp_path):
    (tmp_path / "match.2.mcap").write_bytes(b"another one's")
    rig = make_rig(options=RecordOptions(part_duration=0.5))
    rig.begin()
    with pytest.raises(TouchlineError, match=r"match\.2\.mcap: already exists"):
        rig.play(range(60))
    assert (tmp_path / "match.2.mcap").read_bytes() == b"another one's"


def test_a_part_of_another_recording_is_named_when_it_is_read(make_rig, tmp_path):
    for name in ("match", "other"):
        rig = make_rig(path=tmp_path / f"{name}.mcap")
        rig.recorder._host_stream = len(name) + ord(name[0])
        rig.begin()
        rig.play(range(10))
        rig.leave()
    (tmp_path / "other.mcap").rename(tmp_path / "match.2.mcap")
    with pytest.raises(TouchlineError, match=r"match\.2\.mcap: is a part of another recording than .*match\.mcap"):
        open_recording(tmp_path / "match.mcap")
