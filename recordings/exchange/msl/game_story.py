"""The game of a log, told from the referee's signals as this project tells it: states, events, directions, clock."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from recordings.exchange.msl import LOG_PERIOD
from recordings.exchange.msl.event_log import SignalLine
from schemas.game import EventKind, GameEvent, GameState, Phase, Score, Stage
from schemas.league.signals import START

_STATE_S = 1.0
"""The state is said once a second, as a host does."""
RULE = "referee box"
"""What decided, in every event."""


@dataclass(slots=True)
class GameStory:
    """Follows the signals; all times in s since the log begins."""

    told: list[GameState | GameEvent] = field(default_factory=list)
    _now: dict[str, Any] = field(default_factory=lambda: {"phase": Phase.PRE_GAME, "score": Score(), "half": 1})
    _time: float = 0.0
    _clock: float = 0.0
    _effective: float = 0.0
    _base: float = 0.0
    _ticking: bool = False
    _break: bool = False

    def tell(self, lines: list[SignalLine], start_ms: float, duration: float) -> None:
        """Follow all signals; those from before the log begins, or after its end, count as given there."""
        if not lines:
            self._now |= {"phase": Phase.PLAY, "running": True}
            self._ticking = True
        self._say_state()
        for line in lines:
            self._pass(min(max(0.0, (line.moment - start_ms) / 1e3), duration), line.game_s)
            self._take(line)
        self._pass(duration, None)
        self._say_state()

    def attacks(self, times: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """The x direction that cyan attacks at each time, +1 or −1."""
        return self._at(times, [state.cyan_attacks for state in self._states()], stepwise=True)

    def clock(self, times: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """The game clock at each time, s."""
        return self._at(times, [state.clock for state in self._states()], stepwise=False)

    def _states(self) -> Iterator[GameState]:
        return (one for one in self.told if isinstance(one, GameState))

    def _at(self, times: npt.NDArray[np.float64], values: list[Any], *, stepwise: bool) -> npt.NDArray[np.float64]:
        said, told = np.array([state.time for state in self._states()]), np.array(values, dtype=float)
        if not stepwise:
            between: npt.NDArray[np.float64] = np.interp(times, said, told)
            return between
        newest: npt.NDArray[np.int64] = np.searchsorted(said, times + 1e-9, side="right") - 1
        stepped: npt.NDArray[np.float64] = np.take(told, np.maximum(newest, 0))
        return stepped

    def _pass(self, time: float, said: float | None) -> None:
        """Let time pass, with a state each second; the box's own clock is right where it is off by a second."""
        while self._time + _STATE_S <= time:
            self._advance(self._time + _STATE_S)
            self._say_state()
        self._advance(max(time, self._time))
        if said is not None and self._ticking and not 0.0 <= self._clock - (self._base + said) < 1.0:
            self._clock = max(self._clock, self._base + said)

    def _advance(self, time: float) -> None:
        if self._ticking:
            self._clock += time - self._time
        if self._now["phase"] is Phase.PLAY:
            self._effective += time - self._time
        self._time = time

    def _take(self, line: SignalLine) -> None:
        signal = line.signal
        begins = signal.half or max(line.half, self._now["half"] + self._break)
        restarts = signal is START or signal.kind is EventKind.RESTART or bool(signal.half)
        if restarts and begins > self._now["half"]:
            self._begin_half(begins)
        if signal.phase is not None:
            side = line.side if signal.sided else None
            self._now |= {"phase": signal.phase, "side": side, "running": signal is START}
            self._break = signal.phase is Phase.HALF_TIME
            self._ticking = (self._ticking or signal is START) and signal.phase not in (
                Phase.HALF_TIME,
                Phase.FULL_TIME,
            )
        if signal.goals and line.side is not None:
            before: Score = self._now["score"]
            if before.of(line.side) + signal.goals >= 0:
                self._now["score"] = before.plus(line.side, signal.goals)
        self._say_event(line)
        self._say_state()

    def _begin_half(self, half: int) -> None:
        """The teams change sides (reference 9.4: each team's own axes turn with it)."""
        turned = (half - self._now["half"]) % 2 == 1
        attacks = self._now.get("cyan_attacks", 1)
        self._now |= {"half": half, "cyan_attacks": -attacks if turned else attacks}
        self._now |= {"phase": Phase.STOPPED, "side": None, "running": False}
        self._now["stage"] = Stage.REGULAR if half <= 2 else Stage.EXTRA_TIME
        self._base, self._ticking, self._break = self._clock, False, False

    def _say_event(self, line: SignalLine) -> None:
        signal = line.signal
        event = GameEvent(
            **self._moment(),
            clock=self._clock,
            kind=signal.kind,
            rule=RULE,
            side=line.side,
            score=self._now["score"] if signal.goals else None,
            card=signal.card,
            text=line.text,
        )
        self.told.append(event)

    def _say_state(self) -> None:
        self.told.append(GameState(**self._moment(), clock=self._clock, effective=self._effective, **self._now))

    def _moment(self) -> dict[str, Any]:
        return {"tick": int(self._time / LOG_PERIOD + 1e-6), "time": self._time}
