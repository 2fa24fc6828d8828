"""The referee's lines of a log, from what a recording says of the game."""

from collections.abc import Mapping

from schemas.game import GameStage, GameState, Phase
from schemas.league.calls import calls
from schemas.league.signals import Signal
from schemas.side import Side

_PARTS = {1: "1st Half", 2: "2nd Half", 3: "Overtime - 1st Half", 4: "Overtime - 2nd Half"}


class GameLog:
    """Follows the game; each change of its state becomes the signals that lead there."""

    def __init__(self, start_ms: int, sides: Mapping[str, Side]) -> None:
        """`start_ms` is when the recording began, ms since 1970; `sides` tells whose robots are whose."""
        self._start_ms = start_ms
        self._sides = sides
        self._half_began = 0.0
        self._effective_began = 0.0
        self.state: GameState | None = None
        """The newest."""
        self.lines: list[str] = []

    def game_s(self, clock: float) -> float:
        """The box's clock, which begins anew with each half, from the match's."""
        return max(0.0, clock - self._half_began)

    def update(self, state: GameState) -> None:
        """The next state."""
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
    """What RefBox calls this part of the game."""
    if state.phase is Phase.PRE_GAME:
        return "Pre-Game"
    if state.phase is Phase.FULL_TIME:
        return "End Game"
    if state.phase is Phase.HALF_TIME:
        return "Halftime" if state.stage is GameStage.REGULAR else "Overtime - Halftime"
    if state.stage is GameStage.SHOOT_OUT:
        return "Penalties" if state.running else "Penalties/STOP"
    part = _PARTS.get(state.half, f"Half {state.half}")
    return part if state.running else f"{part} - STOP"


def _line(epoch_ms: int, game_s: float, run_s: float, state: str, signal: Signal, side: Side | None) -> str:
    """A line of the event file, as the referee box wrote it until 2019: five columns."""
    character = signal.character.lower() if side is Side.MAGENTA else signal.character
    says = f"{side.value.upper()} {signal.description}" if side is not None and signal.sided else signal.description
    return f"{epoch_ms},{_minutes(game_s)}({_minutes(run_s)}),{state},{character},{says}"


def _minutes(seconds: float) -> str:
    whole = max(0, int(seconds))
    return f"{whole // 60:02d}:{whole % 60:02d}"
