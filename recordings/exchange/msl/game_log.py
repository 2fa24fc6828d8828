"""The referee's lines of a log, from what a recording says of the game."""

from recordings.exchange.msl.signals import (
    CARD_OF,
    END_GAME,
    GOAL,
    HALF_OF,
    HALF_TIME,
    RESTART_OF,
    START,
    STOP,
    SUBGOAL,
    Signal,
    line,
)
from schemas.game import EventKind, GameEvent, GameState, Phase, Stage
from schemas.side import Side

_ENDS = {Phase.STOPPED: STOP, Phase.HALF_TIME: HALF_TIME, Phase.FULL_TIME: END_GAME}
_PARTS = {1: "1st Half", 2: "2nd Half", 3: "Overtime - 1st Half", 4: "Overtime - 2nd Half"}


class GameLog:
    """Follows the game; each change of its state becomes a signal, and each card."""

    def __init__(self, start_ms: int) -> None:
        self._start_ms = start_ms
        self._half_began = 0.0
        self._effective_began = 0.0
        self.state: GameState | None = None
        """The newest."""
        self.lines: list[str] = []

    def game_s(self, clock: float) -> float:
        """The box's clock, which begins anew with each half, from the match's."""
        return max(0.0, clock - self._half_began)

    def take(self, message: GameState | GameEvent) -> None:
        """The next state or event."""
        if isinstance(message, GameState):
            self._state(message)
        elif message.kind is EventKind.CARD and message.card is not None:
            self._say(message.time, CARD_OF[message.card], message.side)

    def _state(self, new: GameState) -> None:
        old, self.state = self.state, new
        for side in Side:
            change = new.score.of(side) - (old.score.of(side) if old is not None else 0)
            for _ in range(abs(change)):
                self._say(new.time, GOAL if change > 0 else SUBGOAL, side)
        if old is None or new.half != old.half:
            self._half_began, self._effective_began = new.clock, new.effective
            if new.half in HALF_OF:
                self._say(new.time, HALF_OF[new.half], None)
        before = (old.phase, old.side) if old is not None else (Phase.PRE_GAME, None)
        if (new.phase, new.side) != before:
            if new.phase in RESTART_OF:
                self._say(new.time, RESTART_OF[new.phase], new.side)
            elif new.phase in _ENDS:
                self._say(new.time, _ENDS[new.phase], None)
        if new.running and (old is None or not old.running):
            self._say(new.time, START, None)

    def _say(self, time: float, signal: Signal, side: Side | None) -> None:
        state = self.state
        clock, effective = (state.clock, state.effective) if state is not None else (0.0, 0.0)
        part = _part(state) if state is not None else "Pre-Game"
        moment = self._start_ms + round(time * 1e3)
        self.lines.append(
            line(moment, self.game_s(clock), max(0.0, effective - self._effective_began), part, signal, side)
        )


def _part(state: GameState) -> str:
    """What the box calls this part of the game (reference 9.3)."""
    if state.phase is Phase.PRE_GAME:
        return "Pre-Game"
    if state.phase is Phase.FULL_TIME:
        return "End Game"
    if state.phase is Phase.HALF_TIME:
        return "Halftime" if state.stage is Stage.REGULAR else "Overtime - Halftime"
    if state.stage is Stage.SHOOT_OUT:
        return "Penalties" if state.running else "Penalties/STOP"
    part = _PARTS.get(state.half, f"Half {state.half}")
    return part if state.running else f"{part} - STOP"
