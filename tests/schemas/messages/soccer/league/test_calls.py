"""What the league's box would signal as our game goes on."""

from typing import Any

import pytest

from schemas.messages.soccer.game import DisciplinaryRecord, GameState
from schemas.messages.soccer.league.calls import calls
from schemas.messages.soccer.league.robot_numbers import numbers_of
from schemas.side import Side
from schemas.soccer.game import GameStage, OffField, Phase, Score

SIDES = {"cyan1": Side.CYAN, "cyan2": Side.CYAN, "magenta4": Side.MAGENTA}


def state(**content: Any) -> GameState:
    return GameState(**{"tick": 1, "time": 0.02, "phase": Phase.PLAY, "running": True, **content})


def said(old: GameState | None, new: GameState) -> list[str]:
    """`KICKOFF cyan`, `REPAIR magenta magenta4`."""
    return [" ".join(filter(None, (call.signal.name, call.side, call.robot))) for call in calls(old, new, SIDES)]


def stopped(**content: Any) -> GameState:
    return state(phase=Phase.STOPPED, running=False, **content)


def restart(phase: Phase, side: Side | None, **content: Any) -> GameState:
    return state(phase=phase, side=side, **{"running": False, **content})


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (None, state(phase=Phase.PRE_GAME, running=False), []),
        (
            state(phase=Phase.PRE_GAME, running=False),
            restart(Phase.KICK_OFF, Side.CYAN),
            ["FIRST_HALF", "KICKOFF cyan"],
        ),
        (restart(Phase.KICK_OFF, Side.CYAN), restart(Phase.KICK_OFF, Side.CYAN, running=True), ["START"]),
        (restart(Phase.CORNER, Side.CYAN, running=True), state(), []),
        (state(), stopped(), ["STOP"]),
        (state(), stopped(score=Score(magenta=1)), ["STOP", "GOAL magenta"]),
        (stopped(score=Score(magenta=1)), stopped(), ["SUBGOAL magenta"]),
        (stopped(), restart(Phase.THROW_IN, Side.MAGENTA), ["THROWIN magenta"]),
        (stopped(), restart(Phase.DROP_BALL, None), ["DROP_BALL"]),
        (restart(Phase.DROP_BALL, None), state(), ["START"]),
        (state(), state(phase=Phase.PARKING, running=False), ["STOP", "HALF_TIME", "PARK"]),
        (stopped(), state(phase=Phase.PARKING, running=False), ["HALF_TIME", "PARK"]),
        (stopped(), state(phase=Phase.HALF_TIME, running=False), ["HALF_TIME"]),
        (stopped(half=2), state(phase=Phase.PARKING, running=False, half=2), ["END_GAME", "PARK"]),
        (
            state(half=3, stage=GameStage.EXTRA_TIME),
            state(phase=Phase.PARKING, running=False, half=3, stage=GameStage.EXTRA_TIME),
            ["STOP", "HALF_TIME", "PARK"],
        ),
        (state(phase=Phase.PARKING, running=False), state(phase=Phase.HALF_TIME, running=False), []),
        (
            state(phase=Phase.PARKING, running=False, half=2),
            state(phase=Phase.FULL_TIME, running=False, half=2),
            ["GAMEOVER"],
        ),
        (state(), state(phase=Phase.FULL_TIME, running=False), ["STOP", "END_GAME", "GAMEOVER"]),
        (
            state(phase=Phase.HALF_TIME, running=False),
            restart(Phase.KICK_OFF, Side.MAGENTA, half=2),
            ["SECOND_HALF", "KICKOFF magenta"],
        ),
        (
            state(phase=Phase.HALF_TIME, running=False, half=2),
            restart(Phase.KICK_OFF, Side.CYAN, half=3, stage=GameStage.EXTRA_TIME),
            ["FIRST_HALF_OVERTIME", "KICKOFF cyan"],
        ),
        (
            state(phase=Phase.HALF_TIME, running=False, half=4),
            restart(Phase.PENALTY, Side.CYAN, half=4, stage=GameStage.SHOOT_OUT),
            ["PENALTY cyan"],
        ),
        (
            stopped(stage=GameStage.SHOOT_OUT, shoot_out=Score(cyan=1)),
            stopped(stage=GameStage.SHOOT_OUT, shoot_out=Score(cyan=2)),
            ["GOAL cyan"],
        ),
        (stopped(half=2), state(phase=Phase.FULL_TIME, running=False, half=2), ["END_GAME", "GAMEOVER"]),
    ],
)
def test_a_change_of_the_game_is_signalled(old: GameState | None, new: GameState, expected: list[str]) -> None:
    assert said(old, new) == expected


@pytest.mark.parametrize(
    ("was", "now", "expected"),
    [
        (DisciplinaryRecord(), DisciplinaryRecord(yellow=1), ["YELLOW_CARD cyan cyan2"]),
        (
            DisciplinaryRecord(yellow=1),
            DisciplinaryRecord(yellow=2, off_field=OffField.SECOND_YELLOW),
            ["DOUBLE_YELLOW cyan cyan2"],
        ),
        (DisciplinaryRecord(yellow=2), DisciplinaryRecord(red=1, off_field=OffField.RED_CARD), ["RED_CARD cyan cyan2"]),
        (DisciplinaryRecord(), DisciplinaryRecord(off_field=OffField.REPAIR), ["REPAIR cyan cyan2"]),
        (DisciplinaryRecord(off_field=OffField.REPAIR), DisciplinaryRecord(), ["REPAIR_END cyan cyan2"]),
        (DisciplinaryRecord(), DisciplinaryRecord(off_field=OffField.SUBSTITUTION), ["SUBSTITUTION cyan cyan2"]),
        (DisciplinaryRecord(), DisciplinaryRecord(off_field=OffField.SILENT), ["IS_ALIVE cyan cyan2"]),
        (DisciplinaryRecord(off_field=OffField.SILENT), DisciplinaryRecord(), []),
        (DisciplinaryRecord(yellow=1), DisciplinaryRecord(), []),
    ],
)
def test_what_becomes_of_a_robot_is_signalled_with_its_name(
    was: DisciplinaryRecord, now: DisciplinaryRecord, expected: list[str]
) -> None:
    assert said(state(robots={"cyan2": was}), state(robots={"cyan2": now})) == expected


def test_a_robot_of_no_side_is_skipped() -> None:
    assert said(state(), state(robots={"ghost": DisciplinaryRecord(red=1)})) == []


def test_robots_have_the_number_at_the_end_of_their_names_or_their_place() -> None:
    assert numbers_of(SIDES) == {"cyan1": 1, "cyan2": 2, "magenta4": 4}
    assert numbers_of({"keeper": Side.CYAN, "striker7": Side.CYAN}) == {"keeper": 1, "striker7": 2}
    assert numbers_of({"a1": Side.CYAN, "b1": Side.CYAN}) == {"a1": 1, "b1": 2}
