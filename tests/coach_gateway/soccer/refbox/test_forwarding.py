"""What each signal of the box leads to in our game."""

from typing import Any

import pytest

from coach_gateway.soccer.refbox.forwarding import FORWARD, SignalResponse, is_ours, response_to, speaks_for
from schemas.messages.coach import CoachMode
from schemas.messages.soccer.game import GameState
from schemas.messages.soccer.league.signals import BY_NAME, SIGNALS
from schemas.side import Side
from schemas.soccer.game import REFBOX, GameStage, Phase

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
STOPPED = {"phase": Phase.STOPPED}


def led_to(name: str, whose: Side | None = None, which: str | None = None, /, **state: Any) -> SignalResponse:
    content = {"tick": 1, "time": 0.0, "phase": Phase.PLAY, **state}
    return response_to(BY_NAME[name], whose, which, GameState(**content))


def said(found: SignalResponse) -> list[str]:
    assert all(action.source == REFBOX for action in found.actions)
    return [" ".join(filter(None, (action.action, action.side, action.robot))) for action in found.actions]


def test_every_signal_has_its_row() -> None:
    assert set(FORWARD) == {signal.name for signal in SIGNALS}


@pytest.mark.parametrize(
    ("name", "side", "robot", "state", "actions"),
    [
        ("START", None, None, STOPPED, ["start"]),
        ("STOP", None, None, {"running": True}, ["stop"]),
        ("HALT", None, None, {"running": True}, ["stop"]),
        ("KICKOFF", CYAN, None, {"phase": Phase.PRE_GAME}, ["kick_off cyan"]),
        ("FREEKICK", MAGENTA, None, STOPPED, ["free_kick magenta"]),
        ("GOALKICK", CYAN, None, STOPPED, ["goal_kick cyan"]),
        ("THROWIN", MAGENTA, None, STOPPED, ["throw_in magenta"]),
        ("CORNER", CYAN, None, STOPPED, ["corner cyan"]),
        ("PENALTY", CYAN, None, STOPPED, ["penalty cyan"]),
        ("DROP_BALL", None, None, STOPPED, ["drop_ball"]),
        ("CORNER", CYAN, None, {"phase": Phase.CORNER, "side": CYAN}, []),
        ("CORNER", MAGENTA, None, {"phase": Phase.CORNER, "side": CYAN}, ["corner magenta"]),
        ("CORNER", CYAN, None, {"phase": Phase.CORNER, "side": CYAN, "running": True}, ["corner cyan"]),
        ("KICKOFF", MAGENTA, None, {"phase": Phase.HALF_TIME}, ["start", "kick_off magenta"]),
        ("GOAL", CYAN, None, STOPPED, ["goal cyan"]),
        ("SUBGOAL", CYAN, None, STOPPED, ["cancel_goal cyan"]),
        ("YELLOW_CARD", CYAN, "cyan3", STOPPED, ["yellow_card cyan3"]),
        ("DOUBLE_YELLOW", CYAN, "cyan3", STOPPED, ["double_yellow cyan3"]),
        ("RED_CARD", CYAN, "cyan3", STOPPED, ["red_card cyan3"]),
        ("REPAIR", CYAN, "cyan3", STOPPED, ["repair cyan3"]),
        ("REPAIR_END", CYAN, "cyan3", STOPPED, ["enter cyan3"]),
        ("SUBSTITUTION", CYAN, "cyan3", STOPPED, ["substitute cyan3"]),
        ("YELLOW_CARD", CYAN, None, STOPPED, ["yellow_card cyan"]),  # the referee asks the side which robot it is
        ("DOUBLE_YELLOW", CYAN, None, STOPPED, ["double_yellow cyan"]),
        ("RED_CARD", CYAN, None, STOPPED, ["red_card cyan"]),
        ("REPAIR", CYAN, None, STOPPED, ["repair cyan"]),
        ("REPAIR_END", CYAN, None, STOPPED, ["enter cyan"]),
        ("SUBSTITUTION", CYAN, None, STOPPED, ["substitute cyan"]),
        ("HALF_TIME", None, None, STOPPED, ["end_half"]),
        ("END_PART", None, None, STOPPED, ["end_half"]),
        ("END_PART", None, None, {**STOPPED, "half": 4, "stage": GameStage.SHOOT_OUT}, ["end_game"]),
        ("HALF_TIME", None, None, {**STOPPED, "half": 4, "stage": GameStage.SHOOT_OUT}, ["end_game"]),
        ("END_GAME", None, None, {**STOPPED, "half": 2}, ["end_half"]),
        ("END_GAME", None, None, {**STOPPED, "half": 1}, ["end_game"]),
        ("END_GAME", None, None, {**STOPPED, "half": 4, "stage": GameStage.SHOOT_OUT}, ["end_game"]),
        ("GAMEOVER", None, None, {**STOPPED, "half": 2}, ["end_game"]),
        ("SECOND_HALF", None, None, {"phase": Phase.HALF_TIME}, ["start"]),
        ("SECOND_HALF", None, None, STOPPED, []),
        ("FIRST_HALF_OVERTIME", None, None, {"phase": Phase.PARKING}, ["start"]),
        ("FIRST_HALF", None, None, {"phase": Phase.PRE_GAME}, []),
        ("WELCOME", CYAN, None, STOPPED, []),
        ("IS_ALIVE", CYAN, "cyan3", STOPPED, []),
    ],
)
def test_a_signal_becomes_actions(
    name: str, side: Side | None, robot: str | None, state: dict[str, Any], actions: list[str]
) -> None:
    found = led_to(name, side, robot, **state)
    assert said(found) == actions
    assert not found.reason


@pytest.mark.parametrize("name", ["RESET", "TESTMODE_ON", "TESTMODE_OFF", "READY", "CANCEL", "RESTART"])
def test_a_signal_without_a_counterpart_in_our_game_has_a_reason(name: str) -> None:
    found = led_to(name)
    assert not found.actions and name in found.reason


@pytest.mark.parametrize("name", ["KICKOFF", "GOAL", "REPAIR"])
def test_a_command_for_a_team_that_is_not_known_is_not_guessed(name: str) -> None:
    found = led_to(name, None)
    assert not found.actions and "does not name its team" in found.reason


def test_start_is_asked_for_until_the_game_runs() -> None:
    for phase in (Phase.PRE_GAME, Phase.STOPPED, Phase.CORNER, Phase.HALF_TIME):
        assert led_to("START", phase=phase).until_running
    assert not led_to("START", running=True).until_running
    assert not led_to("START", phase=Phase.FULL_TIME).until_running


def test_park_is_an_order_to_the_robots() -> None:
    assert led_to("PARK").order is CoachMode.PARK


def test_one_base_station_alone_speaks_for_both_sides() -> None:
    assert is_ours(BY_NAME["KICKOFF"], MAGENTA, CYAN, [CYAN])
    assert is_ours(BY_NAME["START"], None, MAGENTA, [MAGENTA])
    assert speaks_for(MAGENTA, [MAGENTA]) == (MAGENTA, CYAN)
    assert speaks_for(MAGENTA, list(Side)) == (MAGENTA,)
