"""When the state of the game is published: on a change, after an action, and each second."""

from typing import Any

from sim_host.game.judging import PlayState

_PERIOD_S = 1.0
"""Simulated time after which the state of the game is published again."""


class StateSchedule:
    """Follows the state of the game tick by tick."""

    def __init__(self, tick_s: float) -> None:
        self._every = round(_PERIOD_S / tick_s)
        self._last: tuple[Any, ...] = ()

    def is_due(self, state: PlayState, tick: int, episode: int, *, had_actions: bool) -> bool:
        """Whether the state of this tick is published; called once for each tick."""
        now = *state.change_key, episode
        is_due = now != self._last or had_actions or tick % self._every == 0
        self._last = now
        return is_due
