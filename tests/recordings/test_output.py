"""What a recorder writes when it is told to choose, to split, to keep, to take snapshots, to pause."""

import pytest

from recordings.info import facts_of
from recordings.manifest import Ended
from recordings.numbering import files_at
from recordings.output import Limits
from recordings.reader import open_recording
from recordings.selection import Selection, pattern
from schemas.control import RecorderDeed, RecorderRequest
from schemas.errors import TouchlineError
from schemas.game import Phase, Score
from schemas.topics import CONTROL


def ticks_in(path) -> list[int]:
    recording = open_recording(path, whole=True)
    worlds = [message.tick for _, message in recording.decoded("world")]
    return worlds[1:] if recording.manifest.standing else worlds


def ask(stage, deed: RecorderDeed):
    answer = stage.host.bus.ask(CONTROL, RecorderRequest(deed=deed), name="recorder")
    stage.recorder.pump()
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
    assert bool(pattern(expression).fullmatch(key)) is meant


@pytest.mark.parametrize("expression", ["", "a//b", "/a", "a/", "a*b", "a b", "a?"])
def test_what_is_no_key_expression_is_refused_with_an_example(expression):
    with pytest.raises(TouchlineError, match=r"no key expression.*robot/\*/command"):
        Selection(include=(expression,))


def test_keys_that_are_left_out_are_not_in_the_file_and_not_lost(make_stage):
    stage = make_stage(selection=Selection(("world", "robot/**"), ("robot/cyan2/*",)))
    stage.begin()
    stage.host.referee(0, Phase.PLAY, Score())
    stage.play(range(50))
    stage.host.referee(49, Phase.FULL_TIME, Score())
    summary = stage.leave()

    keys = [channel.key for channel in stage.read().channels]
    assert keys == ["robot/cyan1/command", "robot/magenta1/command", "robot/magenta2/command", "world"]
    assert stage.read().manifest.include == ["world", "robot/**"]
    assert (summary.result.ended, summary.result.tick, summary.result.lost) == (Ended.FULL_TIME, 49, 0)


def test_a_recording_is_split_by_duration_and_each_file_is_whole_in_itself(make_stage):
    stage = make_stage(limits=Limits(duration=1.0))
    stage.begin()
    stage.host.referee(0, Phase.PLAY, Score())
    stage.play(range(170))
    files = stage.leave().files

    assert [file.name for file in files] == [f"match.{n:04d}.mcap" for n in (1, 2, 3, 4)]
    assert [ticks_in(file) for file in files] == [
        list(range(50)),
        list(range(50, 100)),
        list(range(100, 150)),
        list(range(150, 170)),
    ]
    third = open_recording(files[2], whole=True)
    assert third.manifest.setup == stage.host.setup
    assert "message_schemas.json" in third.attachments
    assert third.manifest.part == 3
    assert third.result.ended is Ended.SPLIT
    assert [state.tick for _, state in third.decoded("game/state")] == [0]
    standing = [recorded.key for recorded in third.messages()][: third.manifest.standing]
    assert sorted(standing) == ["game/state", "host/applied", "world"]
    facts = facts_of(third)
    assert (facts.lost, facts.messages) == (0, 50 * 6)


def test_a_recording_is_split_by_size(make_stage):
    stage = make_stage(limits=Limits(size=12_000))
    stage.begin()
    clock = stage.recorder_bus.clock
    for tick in range(600):
        stage.host.play(tick)
        clock.sleep_until(clock.now() + 0.02)
        stage.recorder.pump()
    files = stage.leave().files
    assert len(files) > 1
    assert [tick for file in files for tick in ticks_in(file)] == list(range(600))


def test_the_newest_files_are_kept(make_stage):
    stage = make_stage(limits=Limits(duration=0.5, keep=2))
    stage.begin()
    stage.play(range(160))
    files = stage.leave().files
    assert sorted(path.name for path in stage.path.parent.glob("*.mcap*")) == [file.name for file in files]
    assert [ticks_in(file)[0] for file in files] == [125, 150]


def test_numbered_files_of_another_recording_are_not_written_over(make_stage, tmp_path):
    (tmp_path / "match.0003.mcap").write_bytes(b"another one's")
    with pytest.raises(TouchlineError, match=r"match\.0003\.mcap: is there already"):
        make_stage(limits=Limits(duration=1.0))


@pytest.mark.parametrize(
    "limits", [{"keep": 2}, {"snapshot": 20.0, "size": 100}, {"snapshot": 20.0, "duration": 3.0}], ids=str
)
def test_limits_that_do_not_go_together_are_refused(limits):
    with pytest.raises(TouchlineError, match="--snapshot"):
        Limits(**limits)


def test_a_goal_leaves_a_snapshot_of_the_seconds_before_it_and_nothing_else_is_written(make_stage):
    stage = make_stage(limits=Limits(snapshot=2.0))
    stage.begin()
    stage.host.referee(0, Phase.PLAY, Score())
    stage.play(range(300))
    assert files_at(stage.path) == []
    stage.host.goal(300)
    stage.play(range(300, 330))
    (file,) = stage.leave().files

    ticks = ticks_in(file)
    assert 300 <= ticks[-1] < 330
    assert ticks == list(range(ticks[-1] - 100, ticks[-1] + 1))
    recording = open_recording(file, whole=True)
    assert [event.text for _, event in recording.decoded("game/event")] == ["goal by cyan2"]
    assert [state.phase for _, state in recording.decoded("game/state")] == [Phase.PLAY]
    assert (recording.result.ended, recording.result.lost) == (Ended.SNAPSHOT, 0)
    assert recording.result.messages == 6 * 101 + 1
    assert facts_of(recording).made == "snapshot: goal"


def test_a_snapshot_is_taken_on_request(make_stage):
    stage = make_stage(limits=Limits(snapshot=1.0))
    stage.begin()
    refused = ask(stage, RecorderDeed.SNAPSHOT)
    assert (refused.accepted, refused.reason) == (False, "it holds nothing yet")
    stage.play(range(100))
    stage.recorder.pump()
    assert ask(stage, RecorderDeed.SNAPSHOT).accepted
    (file,) = files_at(stage.path)
    assert len(ticks_in(file)) == 51


def test_what_comes_during_a_pause_is_counted_and_not_written(make_stage):
    stage = make_stage()
    stage.begin()
    stage.host.referee(0, Phase.PLAY, Score())
    stage.play(range(50))
    stage.recorder.pump()
    assert ask(stage, RecorderDeed.PAUSE).paused
    stage.host.referee(60, Phase.PLAY, Score(cyan=3))
    stage.play(range(50, 100))
    stage.recorder.pump()
    assert not ask(stage, RecorderDeed.RESUME).paused
    stage.play(range(100, 150))
    summary = stage.leave()

    recording = stage.read()
    ticks = [world.tick for _, world in recording.decoded("world")]
    left_out = summary.result.keys["world"].left_out
    assert 40 < left_out < 60
    assert len(set(ticks)) >= 150 - left_out
    assert ticks == sorted(set(ticks)) and ticks[0] == 0 and ticks[-1] == 149
    assert summary.result.lost == 0
    assert [state.score.cyan for _, state in recording.decoded("game/state")] == [0, 3]
    times = [recorded.log_ns for recorded in recording.messages()]
    assert times == sorted(times)


def test_a_recorder_says_how_it_is_doing_and_why_it_refuses(make_stage):
    stage = make_stage()
    stage.begin()
    stage.play(range(10))
    status = ask(stage, RecorderDeed.STATUS)
    assert (status.recorder, status.paused, status.messages, status.tick) == ("recorder", False, 60, 9)
    assert status.file.endswith("match.mcap")
    assert "--split-size" in ask(stage, RecorderDeed.SPLIT).reason
    assert "--snapshot" in ask(stage, RecorderDeed.SNAPSHOT).reason
    assert ask(stage, RecorderDeed.RESUME).reason == "it is not paused"


def test_a_recorder_that_splits_does_so_on_request(make_stage):
    stage = make_stage(limits=Limits(duration=1000.0))
    stage.begin()
    stage.play(range(50))
    stage.recorder.pump()
    assert ask(stage, RecorderDeed.SPLIT).accepted
    stage.play(range(50, 60))
    files = stage.leave().files
    assert [tick for file in files for tick in ticks_in(file)] == list(range(60))
    assert len(files) == 2
