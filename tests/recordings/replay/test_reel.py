"""Recordings that were split, as one tape; also while their recorder goes on."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from recordings.numbering import numbered
from recordings.output import Limits
from recordings.reader import Recorded, open_recording
from recordings.reel import Reel
from recordings.replay.moments import Moment
from recordings.replay.player import stands
from recordings.replay.programme import Programme, Replay
from schemas.clock import SteppedClock
from schemas.errors import TouchlineError
from schemas.game import Phase, Score

TICKS = 200


def play(stage) -> None:
    """Four seconds with a goal in the second and one in the fourth."""
    stage.begin()
    stage.host.referee(0, Phase.PLAY, Score())
    stage.play(range(70))
    stage.host.goal(70)
    stage.play(range(70, 170))
    stage.host.referee(169, Phase.KICK_OFF, Score(cyan=1))
    stage.host.goal(170)
    stage.play(range(170, TICKS))


@pytest.fixture
def whole(make_stage, tmp_path) -> list[Recorded]:
    """The messages of the match as one file has them."""
    stage = make_stage(path=tmp_path / "whole" / "match.mcap")
    play(stage)
    stage.leave()
    return list(stage.read().messages())


@pytest.fixture
def split(make_stage, tmp_path) -> Path:
    """The name of the same match, split into files of half a second."""
    stage = make_stage(path=tmp_path / "split" / "match.mcap", limits=Limits(duration=0.5))
    play(stage)
    stage.leave()
    assert len(stage.output.files) == 8
    return stage.path


def rest(tape: Reel) -> Iterator[Recorded]:
    while (message := tape.peek()) is not None:
        yield message
        tape.skip()


def told(messages) -> list[tuple[str, bytes, int]]:
    return [(message.key, message.payload, message.log_ns) for message in messages]


def test_the_files_of_a_split_recording_are_one_tape_with_every_message_once(split, whole):
    reel = Reel(split)
    assert told(rest(reel)) == told(whole)
    assert (reel.start_ns, reel.end_ns, reel.finished) == (whole[0].log_ns, whole[-1].log_ns, True)


def test_a_file_that_is_named_itself_is_all_of_it(split):
    path = numbered(split, 3)
    recording = open_recording(path)
    assert told(rest(Reel(path))) == told(recording.messages())


def test_following_from_a_file_goes_on_with_those_after_it(split, whole):
    reel = Reel(numbered(split, 6), follow=True)
    found = told(rest(reel))
    assert found[-1] == told(whole)[-1]
    new = [message for message in found if message[2] >= 2_500_000_000]
    assert new == [message for message in told(whole) if message[2] >= 2_500_000_000]


def test_what_was_not_kept_is_not_missed(split, whole):
    for number in (1, 2):
        numbered(split, number).unlink()
    found = told(rest(Reel(split)))
    assert [message for message in found if message[2] >= 1_000_000_000] == [
        message for message in told(whole) if message[2] >= 1_000_000_000
    ]


@pytest.mark.parametrize(
    "ns", [0, 490_000_000, 500_000_000, 1_230_000_000, 3_500_000_000, 3_980_000_000, 9_000_000_000]
)
def test_it_is_wound_to_any_moment_of_any_file(split, whole, ns):
    reel = Reel(split)
    list(rest(reel))
    reel.seek(ns)
    assert told(rest(reel)) == [message for message in told(whole) if message[2] >= ns]


@pytest.mark.parametrize("ns", [500_000_000, 510_000_000, 2_000_000_000, 3_970_000_000])
def test_how_things_stand_is_told_across_the_files(split, whole, ns):
    newest = {message.key: message for message in whole if message.log_ns < ns and stands(message.topic)}
    found = Reel(split).standing(ns, stands)
    assert sorted(told(found)) == sorted(told(newest.values()))


def test_only_what_is_kept_is_on_it(split, whole):
    reel = Reel(split, lambda key: key == "world")
    assert told(rest(reel)) == [message for message in told(whole) if message[0] == "world"]


def test_a_recording_is_followed_from_file_to_file_while_it_is_written(make_stage, tmp_path, whole, written):
    stage = make_stage(path=tmp_path / "live" / "match.mcap", limits=Limits(duration=0.5))
    stage.begin()
    stage.host.referee(0, Phase.PLAY, Score())
    reel: Reel | None = None
    found: list[tuple[str, bytes, int]] = []
    for tick in range(TICKS):
        if tick == 70:
            stage.host.goal(70)
        if tick == 170:
            stage.host.referee(169, Phase.KICK_OFF, Score(cyan=1))
            stage.host.goal(170)
        stage.play(range(tick, tick + 1), pump_every=1)
        if tick % 7 == 6:
            written(stage)
            reel = reel or Reel(stage.path, follow=True)
            reel.grow()
            found += told(rest(reel))
            assert not reel.finished
    stage.leave()
    assert reel is not None
    while reel.grow():
        continue
    found += told(rest(reel))
    assert found == told(whole)
    assert reel.finished


def test_a_replay_behind_a_split_recording_says_everything_in_order(make_stage, tmp_path, written):
    stage, clock = make_stage(path=tmp_path / "live" / "match.mcap", limits=Limits(duration=0.5)), SteppedClock()
    stage.begin()
    stage.play(range(30), pump_every=1)
    written(stage)
    heard: list[Recorded] = []
    player = Replay(Programme(stage.path, follow=True, behind=0.2)).player(clock, say=heard.append)
    for tick in range(30, TICKS):
        stage.play(range(tick, tick + 1), pump_every=1)
        stage.output.sync()
        clock.sleep_until(clock.now() + 0.02)
        player.pump()
    stage.leave()
    while not player.ended:
        clock.sleep_until(clock.now() + 0.05)
        player.pump()
    ticks = [message.message().tick for message in heard if message.key == "world"]
    assert ticks == sorted({*ticks})
    assert ticks[-1] == TICKS - 1
    assert ticks[1:] == list(range(ticks[1], TICKS)), "after what stood when it began, each tick once"


def test_moments_are_counted_through_all_files(split):
    replay = Replay(Programme(split))
    assert replay.moments() == [
        Moment(0.0, "play"),
        Moment(1.38, "goal"),
        Moment(3.38, "goal"),
        Moment(3.38, "kick_off"),
    ]
    assert replay.time_of("goal:2-1") == pytest.approx(2.38)
    assert [event.tick for event in replay.events()] == [70, 170]


def test_a_damaged_file_in_the_middle_is_named(split):
    path = numbered(split, 4)
    path.write_bytes(path.read_bytes()[:-4000])
    with pytest.raises(
        TouchlineError,
        match=r"match\.0004\.mcap: truncated file, and match\.0005\.mcap comes after it; recover it first",
    ):
        list(rest(Reel(split)))
