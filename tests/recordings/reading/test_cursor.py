"""The cursor: every message, from any time, of complete, truncated and growing files; damage is reported."""

import random
from pathlib import Path

import pytest

from recordings.container.parts import part_path
from recordings.reading.cursor import Cursor
from recordings.reading.recording import RecordedMessage, open_recording
from recordings.replay.player import is_latched
from schemas.config.settings import RecordOptions
from schemas.errors import TouchlineError
from schemas.soccer.game import Phase, Score

TICKS = 200


def told(messages) -> list[tuple[str, bytes, int]]:
    return [(message.key, message.payload, message.log_ns) for message in messages]


def rest(cursor: Cursor) -> list:
    """All messages from where it stands."""
    messages = []
    while (message := cursor.peek()) is not None:
        messages.append(message)
        cursor.skip()
    return messages


def test_it_has_the_messages_of_the_recording_in_their_order(recorded):
    assert rest(Cursor(recorded.path)) == list(recorded.messages())


def test_it_seeks_to_any_time(recorded):
    every, cursor = list(recorded.messages()), Cursor(recorded.path)
    for ns in random.Random(1).sample(range(4_000_000_000), 50):
        cursor.seek(ns)
        assert rest(cursor) == [message for message in every if message.log_ns >= ns]


def test_it_knows_the_latched_messages_at_any_time(recorded):
    every, cursor = list(recorded.messages()), Cursor(recorded.path)
    at_messages = [one.log_ns for one in every if is_latched(one.topic)][:20]
    for ns in (*random.Random(2).sample(range(4_000_000_000), 50), *at_messages):
        newest = {one.key: one for one in every if one.log_ns < ns and is_latched(one.topic)}
        assert sorted(cursor.latched(ns, is_latched)) == sorted(newest.values())


def test_it_leaves_out_the_keys_that_are_not_wanted(recorded):
    cursor = Cursor(recorded.path, lambda key: key in ("world", "game/event"))
    assert rest(cursor) == list(recorded.messages("world", "game/event"))


def test_a_cut_file_is_a_prefix_wherever_it_was_cut(recorded, tmp_path):
    whole, every = recorded.path.read_bytes(), list(recorded.messages())
    for size in random.Random(3).sample(range(8, len(whole)), 60):
        cut = tmp_path / "cut.mcap"
        cut.write_bytes(whole[:size])
        messages = rest(Cursor(cut))
        assert messages == every[: len(messages)]


@pytest.mark.slow
def test_a_flipped_bit_is_reported_or_changes_no_message(recorded, tmp_path):
    whole, every = recorded.path.read_bytes(), list(recorded.messages())
    said = 0
    for place in random.Random(4).sample(range(8, len(whole)), 100):
        flipped = bytearray(whole)
        flipped[place] ^= 1 << place % 8
        path = tmp_path / "flipped.mcap"
        path.write_bytes(flipped)
        try:
            open_recording(path)
            messages = rest(Cursor(path))
        except TouchlineError as error:
            assert "\n" not in str(error)
            said += 1
        else:
            assert [one.payload for one in messages] == [one.payload for one in every[: len(messages)]]
    assert said > 10


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
def parted(make_rig, tmp_path) -> Path:
    """The same match in eight parts of half a second."""
    rig = make_rig(path=tmp_path / "parted" / "match.mcap", options=RecordOptions(part_duration=0.5))
    play(rig)
    assert len(rig.leave().files) == 8
    return rig.path


def test_the_parts_of_a_recording_are_read_as_one_with_every_message_once(parted, whole):
    cursor = Cursor(parted)
    assert told(rest(cursor)) == told(whole)
    assert (cursor.start_ns, cursor.end_ns, cursor.finished) == (whole[0].log_ns, whole[-1].log_ns, True)


def test_a_later_part_is_read_alone_with_what_stood_when_it_began(parted):
    path = part_path(parted, 3)
    assert told(rest(Cursor(path))) == told(open_recording(path).messages())


@pytest.mark.parametrize(
    "ns", [0, 490_000_000, 500_000_000, 1_230_000_000, 3_500_000_000, 3_980_000_000, 9_000_000_000]
)
def test_it_seeks_to_any_time_of_any_part(parted, whole, ns):
    cursor = Cursor(parted)
    rest(cursor)
    cursor.seek(ns)
    assert told(rest(cursor)) == [message for message in told(whole) if message[2] >= ns]


@pytest.mark.parametrize("ns", [500_000_000, 510_000_000, 2_000_000_000, 3_970_000_000])
def test_latched_messages_are_found_across_the_parts(parted, whole, ns):
    newest = {message.key: message for message in whole if message.log_ns < ns and is_latched(message.topic)}
    found = Cursor(parted).latched(ns, is_latched)
    assert sorted(told(found)) == sorted(told(newest.values()))


def test_a_recording_is_followed_from_part_to_part_while_it_is_written(make_rig, tmp_path, whole, wait_until_written):
    rig = make_rig(path=tmp_path / "live" / "match.mcap", options=RecordOptions(part_duration=0.5))
    rig.begin()
    rig.host.referee(0, Phase.PLAY, Score())
    cursor: Cursor | None = None
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
            cursor = cursor or Cursor(rig.path)
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
