"""The tape: every message, from any moment, of whole, cut and growing files; what is damaged is said."""

import random

import pytest

from recordings.reader import open_recording
from recordings.replay.player import stands
from recordings.tape import Tape
from schemas.errors import TouchlineError
from schemas.game import Phase, Score


def rest(tape: Tape) -> list:
    """All messages from where it stands."""
    messages = []
    while (message := tape.peek()) is not None:
        messages.append(message)
        tape.skip()
    return messages


def test_it_has_the_messages_of_the_recording_in_their_order(recorded):
    assert rest(Tape(recorded.path)) == list(recorded.messages())


def test_it_winds_to_any_moment(recorded):
    every, tape = list(recorded.messages()), Tape(recorded.path)
    for ns in random.Random(1).sample(range(4_000_000_000), 50):
        tape.seek(ns)
        assert rest(tape) == [message for message in every if message.log_ns >= ns]


def test_it_knows_how_things_stood_at_any_moment(recorded):
    every, tape = list(recorded.messages()), Tape(recorded.path)
    for ns in random.Random(2).sample(range(4_000_000_000), 50):
        newest = {one.key: one for one in every if one.log_ns < ns and stands(one.topic)}
        assert sorted(tape.standing(ns, stands)) == sorted(newest.values())


def test_it_leaves_out_the_keys_that_are_not_wanted(recorded):
    tape = Tape(recorded.path, lambda key: key in ("world", "game/event"))
    assert rest(tape) == list(recorded.messages("world", "game/event"))


def test_a_file_that_is_still_written_grows_and_is_one_tape_when_it_is_renamed(stage, written):
    stage.host.referee(0, Phase.PLAY, Score())
    stage.play(range(50))
    part = stage.path.with_name("match.mcap.part")
    written(stage)
    tape = Tape(part)
    seen = rest(tape)
    assert not tape.finished
    stage.play(range(50, 150))
    stage.host.referee(149, Phase.FULL_TIME, Score())
    stage.leave()
    assert tape.grow() and tape.finished and not part.exists()
    assert [*seen, *rest(tape)] == list(stage.read().messages())


def test_a_cut_file_is_a_prefix_wherever_it_was_cut(recorded, tmp_path):
    whole, every = recorded.path.read_bytes(), list(recorded.messages())
    for size in random.Random(3).sample(range(8, len(whole)), 60):
        cut = tmp_path / "cut.mcap"
        cut.write_bytes(whole[:size])
        messages = rest(Tape(cut))
        assert messages == every[: len(messages)]


def test_a_flipped_bit_is_said_or_changes_no_message(recorded, tmp_path):
    whole, every = recorded.path.read_bytes(), list(recorded.messages())
    said = 0
    for place in random.Random(4).sample(range(8, len(whole)), 100):
        flipped = bytearray(whole)
        flipped[place] ^= 1 << place % 8
        path = tmp_path / "flipped.mcap"
        path.write_bytes(flipped)
        try:
            open_recording(path)
            messages = rest(Tape(path))
        except TouchlineError as error:
            assert "\n" not in str(error)
            said += 1
        else:
            assert [one.payload for one in messages] == [one.payload for one in every[: len(messages)]]
    assert said > 20


@pytest.mark.parametrize(("content", "word"), [(b"", "not a recording"), (b"PK\x03\x04" * 10, "not a recording")])
def test_what_is_no_recording_is_said(tmp_path, content, word):
    path = tmp_path / "a.mcap"
    path.write_bytes(content)
    with pytest.raises(TouchlineError, match=word):
        Tape(path)


def test_a_file_that_is_not_there_is_said(tmp_path):
    with pytest.raises(TouchlineError, match="No such file"):
        Tape(tmp_path / "a.mcap")
