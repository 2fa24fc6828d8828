"""What a replay can seek to, in words."""

import pytest

from recordings.replay.seek_targets import SeekTarget, seek_targets_of, time_of
from schemas.errors import TouchlineError

TARGETS = [SeekTarget(1.0, "kick_off"), SeekTarget(4.0, "goal"), SeekTarget(5.0, "kick_off"), SeekTarget(9.0, "goal")]


@pytest.mark.parametrize(
    ("words", "time"),
    [
        ("12.5", 12.5),
        ("goal", 4.0),
        ("goal:2", 9.0),
        ("goal:-1", 9.0),
        ("goal:2-5", 4.0),
        ("kick_off:2+0.5", 5.5),
        ("kick_off-1", 0.0),
    ],
)
def test_seconds_and_events_name_a_seek_target(words, time):
    assert time_of(words, TARGETS) == pytest.approx(time)


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        ("goal:3", "goal happened 2 times; it has kick_off, goal"),
        ("goal:0", "goal happened 2 times"),
        ("corner", "there is no corner"),
        ("gaol", 'did you mean "goal"?'),
        ("goal;1", "give seconds, a tick as in tick:500"),
        ("", "give seconds, a tick as in tick:500"),
        *((text, f'"{text}" is a time that no recording has') for text in ("inf", "-inf", "nan", "-1", "1e300")),
        ("tick:" + "9" * 400, "is a time that no recording has"),
        ("goal:" + "9" * 5000, "give seconds, a tick as in tick:500"),
        ("goal+" + "9" * 400, "is a time that no recording has"),
    ],
)
def test_an_unknown_seek_target_is_reported_in_one_line(words, answer):
    with pytest.raises(TouchlineError) as error:
        time_of(words, TARGETS, 0.02)
    said = str(error.value).replace("not in this recording: ", "").replace(": it has", "; it has")
    assert answer.split(";")[0] in said and "\n" not in said


def test_a_tick_names_its_time():
    assert time_of("tick:50", [], 0.02) == pytest.approx(1.0)


def test_a_tick_needs_the_setup_of_the_match():
    with pytest.raises(TouchlineError, match="lacks the setup"):
        time_of("tick:50", TARGETS)


def test_events_and_phases_of_a_recording_are_seek_targets(recorded):
    targets = seek_targets_of(recorded)
    assert SeekTarget(pytest.approx(1.98), "goal") in targets
    assert SeekTarget(pytest.approx(1.98), "kick_off") in targets
    assert SeekTarget(0.0, "play") in targets
