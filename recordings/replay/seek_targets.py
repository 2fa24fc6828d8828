"""Targets that a replay can seek to: seconds of simulated time, a tick, `tick:812`, or an event, `kick_off:1-5`."""

import re
from collections.abc import Iterator
from typing import NamedTuple

from recordings.reading.recording import Recording, is_time
from schemas.errors import TouchlineError, did_you_mean
from schemas.soccer.game import EventKind, Phase
from schemas.topics import EVENT, STATE

_TICK = re.compile(r"tick:(\d+)")
_EVENT = re.compile(r"([a-z][a-z_]*)(?::(-?\d{1,9}))?([+-]\d+(?:\.\d+)?)?")


class SeekTarget(NamedTuple):
    """An event or a phase to seek to."""

    time: float
    """Simulated time in s."""
    name: str
    """The kind of the event, or the phase that begins."""


def seek_targets_of(recording: Recording) -> list[SeekTarget]:
    """All events, and the beginnings of phases that are not events, by time.

    Raises:
        TouchlineError: the file is damaged inside.
    """
    return sorted([*_events(recording), *_phases(recording)])


def _events(recording: Recording) -> Iterator[SeekTarget]:
    for recorded, event in recording.decoded(EVENT.key):
        yield SeekTarget(recorded.time, event.kind.value)


def _phases(recording: Recording) -> Iterator[SeekTarget]:
    phase: Phase | None = None
    kinds = {kind.value for kind in EventKind}
    for recorded, state in recording.decoded(STATE.key):
        if state.phase is not phase and state.phase.value not in kinds:
            yield SeekTarget(recorded.time, state.phase.value)
        phase = state.phase


def time_in(text: str, recording: Recording) -> float:
    """The simulated time in s of a target in a recording; see `time_of`.

    Raises:
        TouchlineError: the recording does not have this target.
    """
    setup = recording.manifest.setup
    tick_s = setup.time.tick if setup is not None else None
    needs_events = not _TICK.fullmatch(text.strip()) and seconds_in(text) is None
    return time_of(text, seek_targets_of(recording) if needs_events else [], tick_s)


def time_of(text: str, targets: list[SeekTarget], tick_s: float | None = None) -> float:
    """The simulated time in s of a target: a number, `tick:812`, or `NAME[:COUNT][±SECONDS]`.

    `goal:2` is the second goal, `goal:-1` the last, `goal:2-5` five seconds before the second. `tick_s` is the length
    of a tick in s; None where the recording does not have it.

    Raises:
        TouchlineError: neither a time nor an event, or an event that did not happen that often.
    """
    if (seconds := seconds_in(text)) is not None:
        return seconds
    tick = _TICK.fullmatch(text.strip())
    if tick is not None:
        if tick_s is None:
            raise TouchlineError(f'"{text}": the recording lacks the setup with the length of a tick; give seconds')
        return checked(text, float(tick[1]) * tick_s)
    found = _EVENT.fullmatch(text.strip())
    names = [*EventKind, *Phase]
    if found is None:
        raise TouchlineError(
            f'"{text}" is no time and no event; give seconds, a tick as in tick:500, or an event as in goal:2 or '
            "kick_off:1-5"
        )
    name, number, shift = found[1], int(found[2] or 1), float(found[3] or 0.0)
    if name not in names:
        raise TouchlineError(f'"{text}" is not an event; {did_you_mean(name, names)}')
    times = [target.time for target in targets if target.name == name]
    if number == 0 or abs(number) > len(times):
        happened = {target.name: None for target in targets}
        count = f"{name} happened {len(times)} times" if times else f"there is no {name}"
        raise TouchlineError(f'"{text}" is not in this recording: {count}; it has {", ".join(happened) or "no events"}')
    return checked(text, max(0.0, times[number - 1 if number > 0 else number] + shift))


def seconds_in(text: str) -> float | None:
    """The time in s that a text is; None if it is no number.

    Raises:
        TouchlineError: it is a number that no file has a time for.
    """
    try:
        seconds = float(text)
    except ValueError:
        return None
    return checked(text, seconds)


def checked(text: str, seconds: float) -> float:
    """The time in s that a text stands for.

    Raises:
        TouchlineError: no file has it.
    """
    if not is_time(seconds):
        raise TouchlineError(f'"{text}" is a time that no recording has; give seconds from 0 on')
    return seconds
