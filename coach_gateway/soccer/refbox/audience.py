"""The feed that the league's box sends to audience and score displays, made from our game. Pure."""

from collections.abc import Mapping
from typing import Any

from schemas.messages.setup import Setup
from schemas.messages.soccer.game import DisciplinaryRecord, GameState
from schemas.messages.soccer.league.calls import Call, minutes
from schemas.side import Side
from schemas.soccer.game import GameStage, OffField, Phase

VERSION = "1.2.0"
_COLOURS = {Side.CYAN: "00FFFF", Side.MAGENTA: "FF00FF"}
_SHORT, _LONG = 8, 24
"""Letters of a team's short and long name, at most."""
_ROBOTS = 5
"""Robots of a team in the feed."""
_STATES: tuple[str, ...] = (
    *("Pre-Game", "1st Half - STOP", "1st Half", "Halftime", "2nd Half - STOP", "2nd Half"),
    *("Pre-Overtime", "Overtime - 1st Half - STOP", "Overtime - 1st Half", "Overtime - Halftime"),
    *("Overtime - 2nd Half - STOP", "Overtime - 2nd Half", "Penalties - STOP", "Penalties", "End Game"),
)
"""The box's states by number."""
_STOPPED_IN_HALF = {1: 1, 2: 4, 3: 7, 4: 10}
_AFTER_HALF = {1: 3, 2: 6, 3: 9, 4: 12}
_BREAKS = (Phase.HALF_TIME, Phase.PARKING)
_WORDS = {OffField.SECOND_YELLOW: "doubleyellow", OffField.RED_CARD: "red"}


def state_number(state: GameState) -> int:
    """The box's number for the state that our game is in."""
    if state.phase is Phase.PRE_GAME:
        return 0
    if state.phase is Phase.FULL_TIME:
        return 14
    if state.stage is GameStage.SHOOT_OUT:
        return 13 if state.running else 12
    half = min(state.half, 4)
    if state.phase in _BREAKS:
        return _AFTER_HALF[half]
    return _STOPPED_IN_HALF[half] + state.running


class Audience:
    """Follows the game for the audience."""

    def __init__(self) -> None:
        self._half = 1
        self._half_began = 0.0
        self._effective_began = 0.0

    def teams(self, state: GameState, setup: Setup, worlds: Mapping[Side, Mapping[str, Any]]) -> dict[str, Any]:
        """The object that is sent periodically; `worlds` are the teams' world states."""
        if state.half != self._half or state.clock < self._half_began:
            self._half, self._half_began, self._effective_began = state.half, state.clock, state.effective
        number = state_number(state)
        return {
            "type": "teams",
            "version": VERSION,
            "gameState": number,
            "gameStateString": _STATES[number],
            "gameTime": minutes(state.clock - self._half_began),
            "gameRunTime": minutes(state.effective - self._effective_began),
            "teamA": _team(Side.CYAN, state, setup, worlds),
            "teamB": _team(Side.MAGENTA, state, setup, worlds),
        }


def event(call: Call, setup: Setup, numbers: Mapping[str, int]) -> dict[str, Any]:
    """The object of one command; `robotID` is −1 where it names no robot."""
    return {
        "type": "event",
        "eventCode": call.signal.name,
        "eventDesc": call.signal.description,
        "team": setup.teams[call.side].name if call.side is not None else "",
        "robotID": numbers.get(call.robot or "", -1),
    }


def _team(side: Side, state: GameState, setup: Setup, worlds: Mapping[Side, Mapping[str, Any]]) -> dict[str, Any]:
    team = setup.teams[side]
    records = [state.robots.get(name, DisciplinaryRecord()) for name in team.robots[:_ROBOTS]]
    records += [DisciplinaryRecord()] * (_ROBOTS - len(records))
    return {
        "color": _COLOURS[side],
        "shortName": team.name[:_SHORT],
        "longName": team.name[:_LONG],
        "score": str(state.score.of(side)),
        "robotState": [_robot_state(record) for record in records],
        "robotWaitTime": [round(record.left or 0.0) for record in records],
        "worldState": worlds.get(side, {}),
    }


def _robot_state(record: DisciplinaryRecord) -> str:
    """The box's word for a robot; one off the field for a reason that the box lacks is in repair."""
    if record.off_field is not None:
        return _WORDS.get(record.off_field, "repair")
    return "yellow" if record.yellow else "play"
