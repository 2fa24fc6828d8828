"""Index of the recorded ticks of a match: those a simulation can start with, and those that are missing."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple

from pydantic_core import from_json

from recordings.reading.recording import RecordedMessage, Recording, is_time
from schemas.messages.applied import Applied
from schemas.messages.soccer.game import GameState
from schemas.soccer.game import Phase
from schemas.topics import APPLIED, STATE, WORLD
from schemas.wire.message import BadMessageError

_CHANGES = ("parameters", "robots", "obstacles")
_SETTLING_TICKS = 50
"""Ticks after its start from which a recorder has every command."""


class StartTick(NamedTuple):
    """A tick that a simulation can start with: tick 0, or one before which the world was rebuilt."""

    tick: int
    kick_off: int | None
    """Number of the kick-off, from 1; None if the tick is not a kick-off."""
    changes: tuple[Applied, ...]
    """Earlier changes of parameters, robots and obstacles."""


class SkipReason(StrEnum):
    """Why ticks cannot be simulated again."""

    BEFORE = "before"
    """They were played before the recording began."""
    MISSING = "missing"
    """They are missing within the recording."""
    NO_START = "no_start"
    """They precede the first tick that a simulation can start with."""


class SkippedTicks(NamedTuple):
    """Ticks that cannot be simulated again."""

    first: int
    last: int
    why: SkipReason


class Segment(NamedTuple):
    """Consecutive ticks that are simulated again from one start."""

    ticks: range
    start: StartTick
    seconds: tuple[float, float]
    """Simulated time of the first and the last of them, in s."""
    answers_from: int
    """The answers to the sights of this tick and later ones must have been recorded."""


@dataclass(slots=True)
class TickIndex:
    """The ticks of a recording."""

    starts: list[StartTick] = field(default_factory=list)
    runs: list[range] = field(default_factory=list)
    """Ranges of consecutive ticks; between two of them ticks are missing."""
    times: dict[int, float] = field(default_factory=dict)
    """Tick → simulated time in s."""
    unreadable: int = 0
    """Payloads of `host/applied` that are not valid messages."""

    def segments(self, since: int, worth: float) -> Iterator[Segment]:
        """Yield all that can be simulated again from tick `since` on, in segments of at least `worth` ticks."""
        for run in self.runs:
            starts = [start for start in self.starts if start.tick in run and start.tick >= since]
            while starts:
                first = starts.pop(0)
                while starts and starts[0].tick - first.tick < worth:
                    starts.pop(0)
                ticks = range(first.tick, starts[0].tick if starts else run.stop)
                # at the start of a recording, commands may start a little later
                answers_from = max(ticks.start - 1, run.start + _SETTLING_TICKS if run.start else 0)
                yield Segment(ticks, first, (self.times[ticks.start], self.times[ticks[-1]]), answers_from)

    def skipped(self, since: int) -> Iterator[SkippedTicks]:
        """Yield the ticks from `since` on that are in no segment."""
        after = since
        for number, run in enumerate(self.runs):
            if run.stop <= since:
                continue
            if run.start > after:
                yield SkippedTicks(after, run.start - 1, SkipReason.MISSING if number else SkipReason.BEFORE)
            begins = max(run.start, since)
            first = next((start.tick for start in self.starts if begins <= start.tick < run.stop), run.stop)
            if first > begins:
                yield SkippedTicks(begins, first - 1, SkipReason.NO_START)
            after = run.stop

    @property
    def kick_offs(self) -> list[StartTick]:
        """The starts that are kick-offs, in order."""
        return [start for start in self.starts if start.kick_off is not None]


def tick_index_of(recording: Recording) -> TickIndex:
    """The tick index of a recording, from one pass over `host/applied`."""
    index = TickIndex()
    changes: list[Applied] = []
    began, kick_offs = _kick_offs(recording), 0
    worlds = {recorded.log_ns for recorded in recording.messages(WORLD.key)}
    begins_ns = recording.manifest.begins_ns
    before: _AppliedSummary | None = None
    for recorded in recording.messages(APPLIED.key):
        summary = _summary_of(recorded)
        if summary is None or (before is not None and summary.tick <= before.tick):
            index.unreadable += 1
            continue
        tick = summary.tick
        is_next = before is not None and tick == before.tick + 1
        if recorded.log_ns >= begins_ns:
            if is_next and index.runs and index.runs[-1].stop == tick:
                index.runs[-1] = range(index.runs[-1].start, tick + 1)
            else:
                index.runs.append(range(tick - is_next, tick + 1))  # the run includes a latched tick before it
        if tick == 0 or (summary.checkpoint and is_next and before is not None and before.log_ns in worlds):
            is_kick_off = tick - 1 in began
            kick_offs += is_kick_off
            kick_off = kick_offs if is_kick_off else None
            index.starts.append(StartTick(tick, kick_off, tuple(changes)))
        if summary.changes is not None:
            changes.append(summary.changes)
        index.times[tick] = summary.time
        before = summary
    return index


class _AppliedSummary(NamedTuple):
    tick: int
    time: float
    log_ns: int
    checkpoint: bool
    changes: Applied | None


def _summary_of(recorded: RecordedMessage) -> _AppliedSummary | None:
    """The fields of `host/applied` besides the inputs; None if the payload is not a valid message."""
    try:
        fields: dict[str, Any] = from_json(recorded.payload)
        tick, time = fields["tick"], fields["time"]
        if not isinstance(tick, int) or not is_time(time):
            return None
        changes = recorded.message() if any(name in fields for name in _CHANGES) else None
    except (BadMessageError, ValueError, KeyError, TypeError):
        return None
    return _AppliedSummary(tick, time, recorded.log_ns, bool(fields.get("checkpoint")), changes)


def _kick_offs(recording: Recording) -> set[int]:
    """The ticks at which a kick-off was started, from the game state."""
    ticks, was_running = set(), False
    state: GameState
    for _, state in recording.decoded(STATE.key):
        runs = state.phase is Phase.KICK_OFF and state.running
        if runs and not was_running:
            ticks.add(state.tick)
        was_running = runs
    return ticks
