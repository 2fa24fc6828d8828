"""Reconstructs the game of a log from the referee's signals: game states, events, directions, clock."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from recordings.soccer.league import LOG_PERIOD
from recordings.soccer.league.event_log import SignalLine
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.soccer.league.signals import START
from schemas.soccer.game import EventKind, GameStage, Phase, Score

_STATE_S = 1.0
"""s between two game states, as published by a host."""
RULE = "referee box"
"""The rule of every event."""


@dataclass(slots=True)
class GameReconstruction:
    """Follows the signals; times in s since the beginning of the log."""

    messages: list[GameState | GameEvent] = field(default_factory=list)
    _now: dict[str, Any] = field(default_factory=lambda: {"phase": Phase.PRE_GAME, "score": Score(), "half": 1})
    _time: float = 0.0
    _clock: float = 0.0
    _effective: float = 0.0
    _base: float = 0.0
    _clock_runs: bool = False
    _is_break: bool = False

    def reconstruct(self, lines: list[SignalLine], start_ms: float, duration: float) -> None:
        """Follow all signals, to the end of the log or the last signal; earlier ones are moved to the beginning."""
        if not lines:
            self._now |= {"phase": Phase.PLAY, "running": True}
            self._clock_runs = True
        self._add_state()
        for line in lines:
            self._advance_to(max(0.0, (line.epoch_ms - start_ms) / 1e3), line.game_s)
            self._apply(line)
        self._advance_to(max(duration, self._time), None)
        self._add_state()

    def attacks(self, times: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """The x direction in which cyan attacks at each time, +1 or −1."""
        return self._values_at(times, [state.cyan_attacks for state in self._states()], stepwise=True)

    def clock(self, times: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """The game clock at each time, in s."""
        return self._values_at(times, [state.clock for state in self._states()], stepwise=False)

    def _states(self) -> Iterator[GameState]:
        return (one for one in self.messages if isinstance(one, GameState))

    def _values_at(
        self, times: npt.NDArray[np.float64], values: list[Any], *, stepwise: bool
    ) -> npt.NDArray[np.float64]:
        state_times, state_values = np.array([state.time for state in self._states()]), np.array(values, dtype=float)
        if not stepwise:
            between: npt.NDArray[np.float64] = np.interp(times, state_times, state_values)
            return between
        newest: npt.NDArray[np.int64] = np.searchsorted(state_times, times + 1e-9, side="right") - 1
        stepped: npt.NDArray[np.float64] = np.take(state_values, np.maximum(newest, 0))
        return stepped

    def _advance_to(self, time: float, box_clock: float | None) -> None:
        """Advance the time, with a game state each second; the box's clock takes precedence if it is ahead."""
        while self._time + _STATE_S <= time:
            self._advance(self._time + _STATE_S)
            self._add_state()
        self._advance(max(time, self._time))
        if box_clock is not None and self._clock_runs:
            self._clock = max(self._clock, self._base + box_clock)

    def _advance(self, time: float) -> None:
        if self._clock_runs:
            self._clock += time - self._time
        if self._now["phase"] is Phase.PLAY:
            self._effective += time - self._time
        self._time = time

    def _apply(self, line: SignalLine) -> None:
        signal = line.signal
        half = signal.half or max(line.half, self._now["half"] + self._is_break)
        restarts = signal is START or signal.kind is EventKind.RESTART or bool(signal.half)
        if line.is_shoot_out and self._now.get("stage") is not GameStage.SHOOT_OUT:
            self._begin_shoot_out()
        elif restarts and half > self._now["half"]:
            self._begin_half(half)
        if signal.phase is not None:
            side = line.side if signal.sided else None
            self._now |= {"phase": signal.phase, "side": side, "running": signal is START}
            self._is_break = signal.phase is Phase.HALF_TIME
            stands = signal.phase in (Phase.HALF_TIME, Phase.FULL_TIME) or line.is_shoot_out
            self._clock_runs = (self._clock_runs or signal is START) and not stands
        if signal.goals and line.side is not None:
            before: Score = self._now[self._counted]
            if before.of(line.side) + signal.goals >= 0:
                self._now[self._counted] = before.plus(line.side, signal.goals)
        self._add_event(line)
        self._add_state()

    def _begin_half(self, half: int) -> None:
        """Begin a half; the teams change sides, and each team's own axes turn with it."""
        turned = (half - self._now["half"]) % 2 == 1
        attacks = self._now.get("cyan_attacks", 1)
        self._now |= {"half": half, "cyan_attacks": -attacks if turned else attacks}
        self._now |= {"phase": Phase.STOPPED, "side": None, "running": False}
        self._now["stage"] = GameStage.REGULAR if half <= 2 else GameStage.EXTRA_TIME
        self._base, self._clock_runs, self._is_break = self._clock, False, False

    def _begin_shoot_out(self) -> None:
        """Begin the penalty shoot-out: its goals count apart, and no clock runs."""
        self._now |= {"stage": GameStage.SHOOT_OUT, "shoot_out": Score()}
        self._clock_runs, self._is_break = False, False

    @property
    def _counted(self) -> str:
        """The field of the game state in which goals count now."""
        return "shoot_out" if self._now.get("stage") is GameStage.SHOOT_OUT else "score"

    def _add_event(self, line: SignalLine) -> None:
        signal = line.signal
        is_shot = signal.kind is EventKind.GOAL and self._counted == "shoot_out"
        event = GameEvent(
            **self._tick_and_time(),
            clock=self._clock,
            kind=EventKind.SHOT if is_shot else signal.kind,
            rule=RULE,
            side=line.side,
            score=self._now[self._counted] if signal.goals else None,
            card=signal.card,
            text=line.text,
        )
        self.messages.append(event)

    def _add_state(self) -> None:
        self.messages.append(
            GameState(**self._tick_and_time(), clock=self._clock, effective=self._effective, **self._now)
        )

    def _tick_and_time(self) -> dict[str, Any]:
        return {"tick": int(self._time / LOG_PERIOD + 1e-6), "time": self._time}
