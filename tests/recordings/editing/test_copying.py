"""Recordings compared and filtered: what differs first is found, what is copied keeps every byte."""

import pytest

from recordings.container.key_selection import KeySelection
from recordings.container.parts import parts_of
from recordings.editing.filtering import filter_recording
from recordings.inspection.difference import compare
from recordings.inspection.recording_facts import facts_of
from recordings.reading.recording import open_recording
from schemas.config.settings import RecordOptions
from schemas.messages.command import Command, Drive
from schemas.messages.health import Health
from schemas.soccer.game import Phase, Score
from schemas.topics import HEALTH
from support.recorder_rig import ONE_PART


def told(recording) -> list[tuple[str, int, int, int, bytes]]:
    return [(m.key, m.sequence, m.sent_ns, m.log_ns, m.payload) for m in recording.messages()]


@pytest.fixture
def run(make_rig, tmp_path):
    """Records 120 ticks by name; `change` may say something else at tick 60."""

    def record(name: str, change=None, options: RecordOptions = ONE_PART, ticks: int = 120):
        rig = make_rig(path=tmp_path / f"{name}.mcap", options=options)
        rig.begin()
        rig.host.referee(0, Phase.PLAY, Score())
        for tick in range(ticks):
            if tick == 60 and change is not None:
                change(rig.host)
            rig.host.play(tick)
            rig.recorder.pump()
        rig.leave()
        return rig.read()

    return record


def test_two_recordings_of_one_course_of_events_are_identical(run):
    one, other = run("a"), run("b")
    found = compare(one, other)
    assert (found.identical, found.messages, found.keys, found.left_out) == (True, 721, 7, [])


def test_what_depends_on_wall_time_is_left_out_unless_it_is_asked_for(run):
    def health(host):
        host.batches.publisher(HEALTH).put(Health(tick=60, time=1.2, pace="lockstep", real_time_factor=7.0))

    def again(host):
        host.writers["robot/cyan1/command"].put(Command(answers_tick=59, drive=Drive(vx=1.0)))

    one = run("a")
    for name, change, key in (("b", health, "host/health"), ("c", again, "robot/cyan1/command")):
        other = run(name, change)
        assert compare(one, other).identical
        found = compare(one, other, everything=True)
        assert found.first is not None
        assert found.first.key == key


def test_the_first_message_that_differs_is_named_with_its_fields(run):
    def nudge(host):
        world = host.writers["world"]
        put = world.put

        def differ(message):
            world.put = put
            ball = message.ball.replace(x=message.ball.x + 1e-9)
            put(message.replace(ball=ball))

        world.put = differ

    one, other = run("a"), run("b", nudge)
    first = compare(one, other).first
    assert first is not None
    assert (first.key, first.number, first.time, first.missing_in) == ("world", 60, 1.2, "")
    (field,) = first.fields
    assert field.path == "ball.x"
    assert field.by == pytest.approx(1e-9, rel=1e-3)


def test_the_earliest_difference_counts_though_another_key_differs_later(run):
    def changed(host):
        host.goal(60)

    one, other = run("a"), run("b", changed)
    assert compare(one, other).first.key == "game/event"
    assert compare(one, other).first.missing_in == "first"
    assert compare(other, one).first.missing_in == "second"
    assert compare(one, other, KeySelection(exclude=("game/event",))).identical


def test_a_recording_that_ends_earlier_differs_where_it_ends(run):
    one, other = run("a"), run("b", ticks=100)
    first = compare(one, other).first
    assert (first.number, first.time, first.missing_in) == (100, 2.0, "second")


def test_a_filtered_recording_has_the_chosen_keys_and_seconds_byte_for_byte(run, tmp_path):
    recording = run("a")
    out = tmp_path / "part.mcap"
    copied = filter_recording(recording, out, KeySelection(("robot/**", "game/state")), start=1.0, end=2.0)

    part = open_recording(out, whole=True)
    assert part.manifest.made == "filtered"
    assert part.manifest.setup == recording.manifest.setup
    assert part.attachments == recording.attachments
    assert part.manifest.begins_ns == 1_000_000_000  # and before that the state of tick 0
    wanted = [m for m in told(recording) if m[0].startswith("robot/") and 1_000_000_000 <= m[3] < 2_000_000_000]
    assert told(part)[1:] == wanted
    assert told(part)[0][0] == "game/state"
    assert copied == len(wanted) + 1
    facts = facts_of(part)
    assert (facts.messages, facts.lost) == (len(wanted), 0)
    assert part.result.keys["robot/cyan1/command"].messages == 50


def test_a_copy_of_a_copy_says_which_keys_were_chosen_both_times(run, tmp_path):
    first, second = tmp_path / "first.mcap", tmp_path / "second.mcap"
    filter_recording(run("a"), first, KeySelection(("robot/**", "world", "game/**")))
    filter_recording(open_recording(first), second, KeySelection(("host/**", "world")))
    assert open_recording(second).manifest.include == ["world"]


def test_a_truncated_file_can_be_filtered_and_is_reported_as_truncated(run, tmp_path):
    recording = run("a")
    cut = tmp_path / "cut.mcap"
    data = recording.path.read_bytes()
    cut.write_bytes(data[: data.index(b"\x06\0\0\0result")])
    filter_recording(open_recording(cut), tmp_path / "part.mcap", KeySelection(("world",)))
    facts = facts_of(open_recording(tmp_path / "part.mcap"))
    assert (facts.ended, facts.lost) == ("cut_off", 0)


def test_a_recording_of_several_parts_is_read_as_one(run, tmp_path):
    whole = run("whole")
    split = run("split", options=RecordOptions(part_duration=0.5))
    files = parts_of(split.path)
    assert len(files) > 3
    assert told(split) == told(whole)
    assert told_between(split, 0.7, 1.3) == told_between(whole, 0.7, 1.3)
    assert split.result.keys == whole.result.keys
    assert compare(split, whole).identical
    facts, expected = facts_of(split), facts_of(whole)
    assert (facts.messages, facts.lost, facts.tick, facts.duration) == (721, 0, expected.tick, expected.duration)
    assert [(key.key, key.messages, key.rate) for key in facts.keys] == [
        (key.key, key.messages, key.rate) for key in expected.keys
    ]
    assert facts.size == sum(file.stat().st_size for file in files)
    filter_recording(split, tmp_path / "copy.mcap")
    assert told(open_recording(tmp_path / "copy.mcap", whole=True)) == told(whole)


def test_a_part_that_was_cut_off_contradicts_the_result_of_the_last_one(run):
    recording = run("cut", options=RecordOptions(part_duration=0.5))
    middle = parts_of(recording.path)[1]
    middle.write_bytes(middle.read_bytes()[: middle.stat().st_size // 4])
    assert any(sentence.startswith("world: ") for sentence in facts_of(open_recording(recording.path)).contradictions)


def told_between(recording, start: float, end: float) -> list[tuple[str, int]]:
    return [(one.key, one.log_ns) for one in recording.messages(start=start, end=end)]


@pytest.mark.parametrize("removed", range(3))
def test_an_event_that_is_missing_among_others_of_its_tick_is_called_missing(make_rig, tmp_path, removed):
    recordings = []
    for name, left_out in (("a", -1), ("b", removed)):
        rig = make_rig(path=tmp_path / f"{name}.mcap")
        rig.begin()
        rig.play(range(10))
        for number in range(3):
            if number != left_out:
                rig.host.event(10, f"event {number}")
        rig.play(range(10, 80))
        rig.leave()
        recordings.append(open_recording(rig.path))
    for first, second, lacking in ((0, 1, "second"), (1, 0, "first")):
        found = compare(recordings[first], recordings[second]).first
        assert (found.key, found.number, found.missing_in, found.fields) == ("game/event", removed, lacking, [])
