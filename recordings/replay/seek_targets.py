"""Targets that a replay can seek to: seconds of simulated time, or an event, `goal:2`, `kick_off:1-5`."""

import re
from collections.abc import Iterator, Sequence
from itertools import chain
from typing import NamedTuple

from recordings.reading.recording import Recording
from schemas.errors import TouchlineError, did_you_mean
from schemas.game import EventKind, Phase
from schemas.topics import EVENT, STATE

_EVENT = re.compile(r"([a-z][a-z_]*)(?::(-?\d+))?([+-]\d+(?:\.\d+)?)?")


class SeekTarget(NamedTuple):
    """An event or a phase to seek to."""

    time: float
    """Simulated time in s."""
    name: str
    """The kind of the event, or the phase that begins."""


def seek_targets_of(*recordings: Recording) -> list[SeekTarget]:
    """All events, and the beginnings of phases that are not events, by time; of the files of one recording.

    Raises:
        TouchlineError: the file is damaged inside.
    """
    return sorted([*_events(recordings), *_phases(recordings)])


def _events(recordings: Sequence[Recording]) -> Iterator[SeekTarget]:
    for recorded, event in chain.from_iterable(recording.decoded(EVENT.key) for recording in recordings):
        yield SeekTarget(recorded.time, event.kind.value)


def _phases(recordings: Sequence[Recording]) -> Iterator[SeekTarget]:
    """Beginnings of phases; the latched state at the beginning of a file is the phase of the file before."""
    phase: Phase | None = None
    kinds = {kind.value for kind in EventKind}
    for recorded, state in chain.from_iterable(recording.decoded(STATE.key) for recording in recordings):
        if state.phase is not phase and state.phase.value not in kinds:
            yield SeekTarget(recorded.time, state.phase.value)
        phase = state.phase


def time_of(text: str, targets: list[SeekTarget]) -> float:
    """The simulated time in s of a target: a number, or `NAME[:COUNT][±SECONDS]`.

    `goal:2` is the second goal, `goal:-1` the last, `goal:2-5` five seconds before the second.

    Raises:
        TouchlineError: neither a number nor an event, or an event that did not happen that often.
    """
    try:
        return float(text)
    except ValueError:
        found = _EVENT.fullmatch(text.strip())
    names = [*EventKind, *Phase]
    if found is None:
        raise TouchlineError(
            f'"{text}" is no time and no event; give seconds, or an event as in goal:2 or kick_off:1-5'
        )
    name, number, shift = found[1], int(found[2] or 1), float(found[3] or 0.0)
    if name not in names:
        raise TouchlineError(f'"{text}" is not an event; {did_you_mean(name, names)}')
    times = [target.time for target in targets if target.name == name]
    if number == 0 or abs(number) > len(times):
        happened = {target.name: None for target in targets}
        count = f"{name} happened {len(times)} times" if times else f"there is no {name}"
        raise TouchlineError(f'"{text}" is not in this recording: {count}; it has {", ".join(happened) or "no events"}')
    return times[number - 1 if number > 0 else number] + shift
