"""Measures a match tick by tick, while it is played or from its recording: both give the same outcome."""

from collections import Counter
from pathlib import Path

from recordings.reading.recording import open_recording
from recordings.soccer.stats.match_statistics import MatchStatistics, match_ticks_of
from recordings.soccer.stats.match_tick import MatchTick
from schemas.config.task import GameName
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.soccer.game import EventKind
from touchline.matches.engine.outcome import Played


class Measurement:
    """The figures of a match so far."""

    def __init__(self, setup: Setup) -> None:
        self._statistics = MatchStatistics(setup, 0.0, 0.0) if setup.game is GameName.SOCCER else None
        self._first: GameState | None = None
        self._last: GameState | None = None
        self._chain: str | None = None
        self._events: Counter[str] = Counter()

    def update(self, tick: MatchTick) -> None:
        """Add a tick."""
        if self._statistics is not None:
            self._statistics.update(tick)
        self._first, self._last = self._first or tick.state, tick.state
        self._chain = tick.chain
        self._events.update(map(_label, tick.events))

    def played(self, identity: str, recording: Path | None) -> Played:
        """The outcome of the match that is over.

        Raises:
            TouchlineError: the inputs of the last tick are missing.
        """
        if self._chain is None:
            raise TouchlineError("the inputs of the last tick are missing; record host/applied")
        clocks = [state.clock for state in (self._first, self._last) if state is not None]
        return Played(
            identity=identity,
            figures=self._statistics.figures() if self._statistics is not None else None,
            playing_time=clocks[-1] - clocks[0] if clocks else 0.0,
            chain=self._chain,
            recording=str(recording) if recording is not None else None,
            value=self._last.value if self._last is not None else None,
            events=dict(self._events),
        )


def _label(event: GameEvent) -> str:
    """What kind of thing happened, to whom: `goal:cyan`, `foul:magenta (charging)`; a sentence of a score as it is."""
    if event.kind is EventKind.NOTE:
        return event.text
    side = f":{event.side.value}" if event.side is not None else ""
    rule = f" ({event.rule})" if event.rule not in ("", event.kind.value, "score") else ""
    return f"{event.kind.value}{side}{rule}"


def measured(recording: Path, identity: str) -> Played:
    """The outcome of a recorded match.

    Raises:
        TouchlineError: no recording, or one that lacks what figures need.
    """
    opened = open_recording(recording)
    measurement = Measurement(opened.setup)
    for tick in match_ticks_of(opened):
        measurement.update(tick)
    return measurement.played(identity, recording)
