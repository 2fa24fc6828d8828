"""Our referee as commands of the league's box, made from one state after the other. Pure."""

from collections.abc import Mapping

from schemas.messages.soccer.game import GameState
from schemas.messages.soccer.league.calls import Call, calls
from schemas.messages.soccer.league.signals import BY_NAME
from schemas.side import Side
from schemas.soccer.game import EventKind

_HELD = (EventKind.CARD, EventKind.OFF_FIELD, EventKind.ON_FIELD)
"""Signals of these kinds wait until the game next changes its state, as in the box."""
_AT_ONCE = (BY_NAME["SUBSTITUTION"],)
"""Signals that do not wait, whatever their kind."""
_NO_CHANGE = (BY_NAME["GOAL"], BY_NAME["SUBGOAL"], BY_NAME["IS_ALIVE"], *_AT_ONCE)
"""Signals that do not change the state of the game."""
_RESET = Call(BY_NAME["RESET"])


class CallGenerator:
    """Follows the game from its first state on, which gives no command.

    A scene, a reset or another host gives the command RESET.
    """

    def __init__(self) -> None:
        self._old: GameState | None = None
        self._held: list[Call] = []

    def next_calls(self, state: GameState, sides: Mapping[str, Side]) -> list[Call]:
        """The commands of the next state; cards and repairs follow the command that changes the game's state."""
        old, self._old = self._old, state
        if old is None:
            return []
        begun: list[Call] = []
        if state.episode != old.episode or state.tick < old.tick:
            old, self._held, begun = None, [], [_RESET]
        new = calls(old, state, sides)
        now = [call for call in new if not _is_held(call)]
        self._held += [call for call in new if _is_held(call)]
        if any(call.signal not in _NO_CHANGE for call in now):
            now, self._held = now + self._held, []
        return begun + now


def _is_held(call: Call) -> bool:
    return call.signal.kind in _HELD and call.signal not in _AT_ONCE
