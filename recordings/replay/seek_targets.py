"""What a replay can seek to, in words: seconds of simulated time, or an event, `goal:2`, `kick_off:1-5`."""

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
    """Something that can be gone to."""

    time: float
    """s of simulated time."""
    name: str
    """The kind of the event, or the phase that begins."""


def seek_targets_of(*recordings: Recording) -> list[SeekTarget]:
    """Every event, and every phase that begins and is no event itself, in order; of files that follow each other.

    Raises:
        TouchlineError: the file is damaged inside.
    """
    return sorted([*_events(recordings), *_phases(recordings)])


def _events(recordings: Sequence[Recording]) -> Iterator[SeekTarget]:
    for recorded, event in chain.from_iterable(recording.decoded(EVENT.key) for recording in recordings):
        yield SeekTarget(recorded.time, event.kind.value)


def _phases(recordings: Sequence[Recording]) -> Iterator[SeekTarget]:
    """What a file repeats at its beginning is the phase that the file before it ended in."""
    phase: Phase | None = None
    kinds = {kind.value for kind in EventKind}
    for recorded, state in chain.from_iterable(recording.decoded(STATE.key) for recording in recordings):
        if state.phase is not phase and state.phase.value not in kinds:
            yield SeekTarget(recorded.time, state.phase.value)
        phase = state.phase


def time_of(words: str, targets: list[SeekTarget]) -> float:
    """The simulated time in s that words name: a number, or `NAME:COUNT±SECONDS`, of which the name is enough.

    `goal:2` is the second goal, `goal:-1` the last, `goal:2-5` five seconds before the second.

    Raises:
        TouchlineError: no number and no event, or an event that did not happen, or not so often.
    """
    try:
        return float(words)
    except ValueError:
        found = _EVENT.fullmatch(words.strip())
    names = [*EventKind, *Phase]
    if found is None:
        raise TouchlineError(f'"{words}" is no moment; give seconds, or an event as in goal:2 or kick_off:1-5')
    name, number, shift = found[1], int(found[2] or 1), float(found[3] or 0.0)
    if name not in names:
        raise TouchlineError(f'"{words}" names no event; {did_you_mean(name, names)}')
    times = [target.time for target in targets if target.name == name]
    if number == 0 or abs(number) > len(times):
        happened = {target.name: None for target in targets}
        count = f"{name} happened {len(times)} times" if times else f"there is no {name}"
        raise TouchlineError(
            f'"{words}" is not in this recording: {count}; it has {", ".join(happened) or "no events"}'
        )
    return times[number - 1 if number > 0 else number] + shift
