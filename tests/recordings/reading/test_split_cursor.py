"""Recordings that were split, with one cursor; also while their recorder goes on."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from recordings.container.numbering import numbered
from recordings.reading.recording import RecordedMessage, open_recording
from recordings.reading.split_cursor import SplitCursor
from recordings.recorder.file_limits import FileLimits
from recordings.replay.player import is_latched
from recordings.replay.replay import Replay, ReplaySettings
from schemas.errors import TouchlineError
from schemas.game import Phase, Score
from schemas.process.clock import SteppedClock

TICKS = 200


def play(rig) -> None:
    """Four seconds with a goal in the second and one in the fourth."""
    rig.begin()
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(70))
    rig.host.goal(70)
    rig.play(range(70, 170))
    rig.host.referee(169, Phase.KICK_OFF, Score(cyan=1))
    rig.host.goal(170)
    rig.play(range(170, TICKS))


@pytest.fixture
def whole(make_rig, tmp_path) -> list[RecordedMessage]:
    """The messages of the match as one file has them."""
    rig = make_rig(path=tmp_path / "whole" / "match.mcap")
    play(rig)
    rig.leave()
    return list(rig.read().messages())


@pytest.fixture
def split(make_rig, tmp_path) -> Path:
    """The name of the same match, split into files of half a second."""
    rig = make_rig(path=tmp_path / "split" / "match.mcap", limits=FileLimits(duration=0.5))
    play(rig)
    rig.leave()
    assert len(rig.sink.files) == 8
    return rig.path


def rest(cursor: SplitCursor) -> Iterator[RecordedMessage]:
    while (message := cursor.peek()) is not None:
        yield message
        cursor.skip()


def told(messages) -> list[tuple[str, bytes, int]]:
    return [(message.key, message.payload, message.log_ns) for message in messages]


def test_the_files_of_a_split_recording_are_read_as_one_with_every_message_once(split, whole):
    cursor = SplitCursor(split)
    assert told(rest(cursor)) == told(whole)
    assert (cursor.start_ns, cursor.end_ns, cursor.finished) == (whole[0].log_ns, whole[-1].log_ns, True)


def test_a_file_that_is_named_itself_is_all_of_it(split):
    path = numbered(split, 3)
    recording = open_recording(path)
    assert told(rest(SplitCursor(path))) == told(recording.messages())


def test_following_from_a_file_goes_on_with_those_after_it(split, whole):
    cursor = SplitCursor(numbered(split, 6), follow=True)
    found = told(rest(cursor))
    assert found[-1] == told(whole)[-1]
    new = [message for message in found if message[2] >= 2_500_000_000]
    assert new == [message for message in told(whole) if message[2] >= 2_500_000_000]


def test_what_was_not_kept_is_not_missed(split, whole):
    for number in (1, 2):
        numbered(split, number).unlink()
    found = told(rest(SplitCursor(split)))
    assert [message for message in found if message[2] >= 1_000_000_000] == [
        message for message in told(whole) if message[2] >= 1_000_000_000
    ]


@pytest.mark.parametrize(
    "ns", [0, 490_000_000, 500_000_000, 1_230_000_000, 3_500_000_000, 3_980_000_000, 9_000_000_000]
)
def test_it_seeks_to_any_time_of_any_file(split, whole, ns):
    cursor = SplitCursor(split)
    list(rest(cursor))
    cursor.seek(ns)
    assert told(rest(cursor)) == [message for message in told(whole) if message[2] >= ns]


@pytest.mark.parametrize("ns", [500_000_000, 510_000_000, 2_000_000_000, 3_970_000_000])
def test_latched_messages_are_found_across_the_files(split, whole, ns):
    newest = {message.key: message for message in whole if message.log_ns < ns and is_latched(message.topic)}
    found = SplitCursor(split).latched(ns, is_latched)
    assert sorted(told(found)) == sorted(told(newest.values()))


def test_only_what_is_kept_is_on_it(split, whole):
    cursor = SplitCursor(split, lambda key: key == "world")
    assert told(rest(cursor)) == [message for message in told(whole) if message[0] == "world"]


def test_a_recording_is_followed_from_file_to_file_while_it_is_written(make_rig, tmp_path, whole, wait_until_written):
    rig = make_rig(path=tmp_path / "live" / "match.mcap", limits=FileLimits(duration=0.5))
    rig.begin()
    rig.host.referee(0, Phase.PLAY, Score())
    cursor: SplitCursor | None = None
    found: list[tuple[str, bytes, int]] = []
    for tick in range(TICKS):
        if tick == 70:
            rig.host.goal(70)
        if tick == 170:
            rig.host.referee(169, Phase.KICK_OFF, Score(cyan=1))
            rig.host.goal(170)
        rig.play(range(tick, tick + 1), pump_every=1)
        if tick % 7 == 6:
            wait_until_written(rig)
            cursor = cursor or SplitCursor(rig.path, follow=True)
            cursor.grow()
            found += told(rest(cursor))
            assert not cursor.finished
    rig.leave()
    assert cursor is not None
    while cursor.grow():
        continue
    found += told(rest(cursor))
    assert found == told(whole)
    assert cursor.finished


def test_a_replay_that_follows_a_split_recording_publishes_all_messages_in_order(
    make_rig, tmp_path, wait_until_written
):
    rig, clock = make_rig(path=tmp_path / "live" / "match.mcap", limits=FileLimits(duration=0.5)), SteppedClock()
    rig.begin()
    rig.play(range(30), pump_every=1)
    wait_until_written(rig)
    heard: list[RecordedMessage] = []
    player = Replay(ReplaySettings(rig.path, follow=True, behind=0.2)).player(clock, publish=heard.append)
    for tick in range(30, TICKS):
        rig.play(range(tick, tick + 1), pump_every=1)
        rig.sink.sync()
        clock.sleep_until(clock.now() + 0.02)
        player.pump()
    rig.leave()
    while not player.ended:
        clock.sleep_until(clock.now() + 0.05)
        player.pump()
    ticks = [message.message().tick for message in heard if message.key == "world"]
    assert ticks == sorted({*ticks})
    assert ticks[-1] == TICKS - 1
    assert ticks[1:] == list(range(ticks[1], TICKS)), "after what stood when it began, each tick once"


def test_seek_targets_are_counted_through_all_files(split):
    replay = Replay(ReplaySettings(split))
    assert replay.time_of("goal:2-1") == pytest.approx(2.38)
    assert [event.tick for event in replay.events()] == [70, 170]


def test_a_damaged_file_in_the_middle_is_named(split):
    path = numbered(split, 4)
    path.write_bytes(path.read_bytes()[:-4000])
    with pytest.raises(
        TouchlineError,
        match=r"match\.0004\.mcap: truncated file, and match\.0005\.mcap comes after it; recover it first",
    ):
        list(rest(SplitCursor(split)))
