"""Derives the referee's lines of a log from the game states of a recording."""

from collections.abc import Mapping

from schemas.messages.soccer.game import GameState
from schemas.messages.soccer.league.calls import calls, minutes
from schemas.messages.soccer.league.signals import Signal
from schemas.side import Side
from schemas.soccer.game import GameStage, Phase

_PARTS = {1: "1st Half", 2: "2nd Half", 3: "Overtime - 1st Half", 4: "Overtime - 2nd Half"}


class GameLog:
    """Follows the game state, and turns each change into the signals that lead to it."""

    def __init__(self, start_ms: int, sides: Mapping[str, Side]) -> None:
        """`start_ms` is the beginning of the recording in ms since 1970; `sides` are the sides of the robots."""
        self._start_ms = start_ms
        self._sides = sides
        self._half_began = 0.0
        self._effective_began = 0.0
        self.state: GameState | None = None
        """The newest game state."""
        self.lines: list[str] = []

    def game_s(self, clock: float) -> float:
        """Clock of the box in s, which restarts with each half, from the game clock."""
        return max(0.0, clock - self._half_began)

    def update(self, state: GameState) -> None:
        """Add the next game state."""
        before, self.state = self.state, state
        if before is None or state.half != before.half:
            self._half_began, self._effective_began = state.clock, state.effective
        for call in calls(before, state, self._sides):
            self._add_line(state, call.signal, call.side)

    def _add_line(self, state: GameState, signal: Signal, side: Side | None) -> None:
        epoch_ms = self._start_ms + round(state.time * 1e3)
        run = max(0.0, state.effective - self._effective_began)
        self.lines.append(_line(epoch_ms, self.game_s(state.clock), run, _part(state), signal, side))


def _part(state: GameState) -> str:
    """Name of this part of the game in logs of the referee box."""
    if state.phase is Phase.PRE_GAME:
        return "Pre-Game"
    if state.phase is Phase.FULL_TIME:
        return "End Game"
    if state.phase in (Phase.PARKING, Phase.HALF_TIME):
        return "Halftime" if state.stage is GameStage.REGULAR else "Overtime - Halftime"
    if state.stage is GameStage.SHOOT_OUT:
        return "Penalties" if state.running else "Penalties/STOP"
    part = _PARTS.get(state.half, f"Half {state.half}")
    return part if state.running else f"{part} - STOP"


def _line(epoch_ms: int, game_s: float, run_s: float, state: str, signal: Signal, side: Side | None) -> str:
    """A line of the event file, as the referee box wrote it until 2019: five columns."""
    description = (
        f"{side.value.upper()} {signal.description}" if side is not None and signal.sided else signal.description
    )
    return f"{epoch_ms},{minutes(game_s)}({minutes(run_s)}),{state},{signal.character_for(side)},{description}"
