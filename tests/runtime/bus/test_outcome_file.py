from pathlib import Path

from runtime.bus.contract import ReceivedMessage, Stamp
from runtime.bus.outcome_file import read_outcome, write_outcome
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.soccer.game import EventKind, Phase, Score
from schemas.topics import EVENT, STATE

GOAL = GameEvent(tick=20, time=0.4, clock=0.4, kind=EventKind.GOAL, rule="goal", text="goal by cyan3")
OVER = GameState(tick=60, time=1.2, phase=Phase.FULL_TIME, clock=1.2, score=Score(cyan=1))


def test_an_outcome_is_read_as_it_was_published(tmp_path: Path) -> None:
    messages = [
        ReceivedMessage(EVENT, EVENT.key, GOAL.encode(), Stamp(3, 17, 400_000_000)),
        ReceivedMessage(STATE, STATE.key, OVER.encode(), Stamp(9, 18, 1_200_000_000)),
    ]
    write_outcome(tmp_path / "outcome.json", messages)
    assert list(read_outcome(tmp_path / "outcome.json")) == messages


def test_without_a_readable_file_there_is_no_outcome(tmp_path: Path) -> None:
    path = tmp_path / "outcome.json"
    assert list(read_outcome(path)) == []
    path.write_bytes(b"")
    assert list(read_outcome(path)) == []
