"""The cursor: every message, from any time, of complete, truncated and growing files; damage is reported."""

import random

import pytest

from recordings.reading.cursor import Cursor
from recordings.reading.recording import open_recording
from recordings.replay.player import is_latched
from schemas.errors import TouchlineError
from schemas.game import Phase, Score


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


def test_a_file_that_is_still_written_grows_and_is_one_recording_when_it_is_renamed(rig, wait_until_written):
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(50))
    part = rig.path.with_name("match.mcap.part")
    wait_until_written(rig)
    cursor = Cursor(part)
    seen = rest(cursor)
    assert not cursor.finished
    rig.play(range(50, 150))
    rig.host.referee(149, Phase.FULL_TIME, Score())
    rig.leave()
    assert cursor.grow() and cursor.finished and not part.exists()
    assert [*seen, *rest(cursor)] == list(rig.read().messages())


def test_a_cut_file_is_a_prefix_wherever_it_was_cut(recorded, tmp_path):
    whole, every = recorded.path.read_bytes(), list(recorded.messages())
    for size in random.Random(3).sample(range(8, len(whole)), 60):
        cut = tmp_path / "cut.mcap"
        cut.write_bytes(whole[:size])
        messages = rest(Cursor(cut))
        assert messages == every[: len(messages)]


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


@pytest.mark.parametrize(("content", "word"), [(b"", "not a recording"), (b"PK\x03\x04" * 10, "not a recording")])
def test_a_file_that_is_not_a_recording_is_reported(tmp_path, content, word):
    path = tmp_path / "a.mcap"
    path.write_bytes(content)
    with pytest.raises(TouchlineError, match=word):
        Cursor(path)


def test_a_missing_file_is_reported(tmp_path):
    with pytest.raises(TouchlineError, match="No such file"):
        Cursor(tmp_path / "a.mcap")
