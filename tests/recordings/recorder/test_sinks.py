"""The files of a recorder that selects keys, splits, keeps the newest files, takes snapshots or pauses."""

import pytest
from pydantic import ValidationError

from recordings.container.key_selection import KeySelection, key_pattern
from recordings.container.manifest import EndReason
from recordings.container.numbering import files_at
from recordings.inspection.recording_facts import facts_of
from recordings.reading.recording import open_recording
from recordings.recorder.file_limits import FileLimits
from schemas.config.settings import RecordOptions
from schemas.errors import TouchlineError
from schemas.game import Phase, Score
from schemas.messages.recorder import RecorderOperation, RecorderRequest
from schemas.topics import RECORDER_CONTROL


def ticks_in(path) -> list[int]:
    recording = open_recording(path, whole=True)
    worlds = [message.tick for _, message in recording.decoded("world")]
    return worlds[1:] if recording.manifest.latched_count else worlds


def ask(rig, operation: RecorderOperation):
    answer = rig.host.bus.query(RECORDER_CONTROL, RecorderRequest(operation=operation), name="recorder")
    rig.recorder.pump()
    return answer.result(0.0)


@pytest.mark.parametrize(
    ("expression", "key", "meant"),
    [
        ("robot/*/command", "robot/cyan1/command", True),
        ("robot/*/command", "robot/a/b/command", False),
        ("team/**", "team/cyan/belief/cyan1", True),
        ("team/**", "teams", False),
        ("**/order", "order", True),
        ("**", "world", True),
        ("robot/cyan$*/command", "robot/cyan12/command", True),
        ("world", "world/ball", False),
    ],
)
def test_key_expressions_mean_what_they_mean_on_the_bus(expression, key, meant):
    assert bool(key_pattern(expression).fullmatch(key)) is meant


@pytest.mark.parametrize("expression", ["", "a//b", "/a", "a/", "a*b", "a b", "a?"])
def test_what_is_no_key_expression_is_refused_with_an_example(expression):
    with pytest.raises(TouchlineError, match=r"not a key expression.*robot/\*/command"):
        KeySelection(include=(expression,))


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


def test_a_recording_is_split_by_duration_and_each_file_is_whole_in_itself(make_rig):
    rig = make_rig(limits=FileLimits(duration=1.0))
    rig.begin()
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(170))
    files = rig.leave().files

    assert [file.name for file in files] == [f"match.{n:04d}.mcap" for n in (1, 2, 3, 4)]
    assert [ticks_in(file) for file in files] == [
        list(range(50)),
        list(range(50, 100)),
        list(range(100, 150)),
        list(range(150, 170)),
    ]
    third = open_recording(files[2], whole=True)
    assert third.manifest.setup == rig.host.setup
    assert "message_schemas.json" in third.attachments
    assert third.manifest.part == 3
    assert third.result.ended is EndReason.SPLIT
    assert [state.tick for _, state in third.decoded("game/state")] == [0]
    latched = [recorded.key for recorded in third.messages()][: third.manifest.latched_count]
    assert sorted(latched) == ["game/state", "host/applied", "world"]
    facts = facts_of(third)
    assert (facts.lost, facts.messages) == (0, 50 * 6)


def test_a_recording_is_split_by_size(make_rig):
    rig = make_rig(limits=FileLimits(size=12_000))
    rig.begin()
    clock = rig.recorder_bus.clock
    for tick in range(600):
        rig.host.play(tick)
        clock.sleep_until(clock.now() + 0.02)
        rig.recorder.pump()
    files = rig.leave().files
    assert len(files) > 1
    assert [tick for file in files for tick in ticks_in(file)] == list(range(600))


def test_the_newest_files_are_kept(make_rig):
    rig = make_rig(limits=FileLimits(duration=0.5, keep=2))
    rig.begin()
    rig.play(range(160))
    files = rig.leave().files
    assert sorted(path.name for path in rig.path.parent.glob("*.mcap*")) == [file.name for file in files]
    assert [ticks_in(file)[0] for file in files] == [125, 150]


def test_numbered_files_of_another_recording_are_not_written_over(make_rig, tmp_path):
    (tmp_path / "match.0003.mcap").write_bytes(b"another one's")
    with pytest.raises(TouchlineError, match=r"match\.0003\.mcap: already exists"):
        make_rig(limits=FileLimits(duration=1.0))


@pytest.mark.parametrize(
    "limits", [{"keep": 2}, {"snapshot": 20.0, "split_size": 100}, {"snapshot": 20.0, "split_duration": 3.0}], ids=str
)
def test_limits_that_do_not_go_together_are_refused(limits):
    with pytest.raises(ValidationError, match="snapshot"):
        RecordOptions(**limits)


def test_sizes_are_asked_for_in_megabytes():
    assert FileLimits.of(RecordOptions(split_size=1.5, split_duration=60, keep=2)) == FileLimits(1_500_000, 60.0, 2)
    assert FileLimits.of(RecordOptions(snapshot=20)) == FileLimits(snapshot=20.0)


def test_a_goal_leaves_a_snapshot_of_the_seconds_before_it_and_nothing_else_is_written(make_rig):
    rig = make_rig(limits=FileLimits(snapshot=2.0))
    rig.begin()
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(300))
    assert files_at(rig.path) == []
    rig.host.goal(300)
    rig.play(range(300, 330))
    (file,) = rig.leave().files

    ticks = ticks_in(file)
    assert 300 <= ticks[-1] < 330
    assert ticks == list(range(ticks[-1] - 100, ticks[-1] + 1))
    recording = open_recording(file, whole=True)
    assert [event.text for _, event in recording.decoded("game/event")] == ["goal by cyan2"]
    assert [state.phase for _, state in recording.decoded("game/state")] == [Phase.PLAY]
    assert (recording.result.ended, recording.result.lost) == (EndReason.SNAPSHOT, 0)
    assert recording.result.messages == 6 * 101 + 1
    assert facts_of(recording).made == "snapshot: goal"


def test_a_snapshot_is_taken_on_request(make_rig):
    rig = make_rig(limits=FileLimits(snapshot=1.0))
    rig.begin()
    refused = ask(rig, RecorderOperation.SNAPSHOT)
    assert (refused.accepted, refused.reason) == (False, "it has no messages yet")
    rig.play(range(100))
    rig.recorder.pump()
    assert ask(rig, RecorderOperation.SNAPSHOT).accepted
    (file,) = files_at(rig.path)
    assert len(ticks_in(file)) == 51


def test_what_comes_during_a_pause_is_counted_and_not_written(make_rig):
    rig = make_rig()
    rig.begin()
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(50))
    rig.recorder.pump()
    assert ask(rig, RecorderOperation.PAUSE).paused
    rig.host.referee(60, Phase.PLAY, Score(cyan=3))
    rig.play(range(50, 100))
    rig.recorder.pump()
    assert not ask(rig, RecorderOperation.RESUME).paused
    rig.play(range(100, 150))
    summary = rig.leave()

    recording = rig.read()
    ticks = [world.tick for _, world in recording.decoded("world")]
    left_out = summary.result.keys["world"].left_out
    assert 40 < left_out < 60
    assert len(set(ticks)) >= 150 - left_out
    assert ticks == sorted(set(ticks)) and ticks[0] == 0 and ticks[-1] == 149
    assert summary.result.lost == 0
    assert [state.score.cyan for _, state in recording.decoded("game/state")] == [0, 3]
    times = [recorded.log_ns for recorded in recording.messages()]
    assert times == sorted(times)


def test_a_recorder_logs_its_progress_and_why_it_refuses(make_rig):
    rig = make_rig()
    rig.begin()
    rig.play(range(10))
    status = ask(rig, RecorderOperation.STATUS)
    assert (status.recorder, status.paused, status.messages, status.tick) == ("recorder", False, 60, 9)
    assert status.file.endswith("match.mcap")
    assert "--split-size" in ask(rig, RecorderOperation.SPLIT).reason
    assert "--snapshot" in ask(rig, RecorderOperation.SNAPSHOT).reason
    assert ask(rig, RecorderOperation.RESUME).reason == "it is not paused"


def test_a_recorder_that_splits_does_so_on_request(make_rig):
    rig = make_rig(limits=FileLimits(duration=1000.0))
    rig.begin()
    rig.play(range(50))
    rig.recorder.pump()
    assert ask(rig, RecorderOperation.SPLIT).accepted
    rig.play(range(50, 60))
    files = rig.leave().files
    assert [tick for file in files for tick in ticks_in(file)] == list(range(60))
    assert len(files) == 2
