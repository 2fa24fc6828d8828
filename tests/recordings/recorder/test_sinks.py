"""The files of a recorder that selects keys, or splits."""

import pytest

from recordings.container.key_selection import KeySelection, key_pattern
from recordings.container.manifest import EndReason
from recordings.inspection.recording_facts import facts_of
from recordings.reading.recording import open_recording
from recordings.recorder.file_limits import FileLimits
from schemas.config.settings import RecordOptions
from schemas.errors import TouchlineError
from schemas.game import Phase, Score


def ticks_in(path) -> list[int]:
    recording = open_recording(path, whole=True)
    worlds = [message.tick for _, message in recording.decoded("world")]
    return worlds[1:] if recording.manifest.latched_count else worlds


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


def test_numbered_files_of_another_recording_are_not_written_over(make_rig, tmp_path):
    (tmp_path / "match.0003.mcap").write_bytes(b"another one's")
    with pytest.raises(TouchlineError, match=r"match\.0003\.mcap: already exists"):
        make_rig(limits=FileLimits(duration=1.0))


def test_sizes_are_asked_for_in_megabytes():
    assert FileLimits.of(RecordOptions(split_size=1.5, split_duration=60)) == FileLimits(1_500_000, 60.0)
