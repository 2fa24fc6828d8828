"""A replay and its settings: the recording, the range, the rate and the keys."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from recordings.container.key_selection import EVERYTHING, KeySelection, matches
from recordings.reading.cursor import Cursor
from recordings.reading.recording import Recording, open_recording
from recordings.replay.playback_clock import AS_FAST_AS_POSSIBLE
from recordings.replay.player import PlaybackRange, Player
from recordings.replay.seek_targets import time_in
from runtime.process.clock import Clock
from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.soccer.game import GameEvent
from schemas.topics import EVENT


@dataclass(frozen=True, slots=True)
class ReplaySettings:
    """Settings of a replay."""

    file: Path
    start: str | None = None
    """Seconds, a tick or an event; None for the beginning."""
    end: str | None = None
    rate: float | None = 1.0
    """Simulated seconds per wall second; None for as fast as possible."""
    loop: bool = False
    paused: bool = False
    stay: bool = False
    """Pause at the end instead of ending."""
    selection: KeySelection = EVERYTHING
    """Keys that are played."""
    follow: bool = False
    """Follow a recording that is still being written."""
    behind: float = 5.0
    """With `follow`: where to begin, in s of simulated time before the newest message."""


class Replay:
    """A recording that is opened for replay."""

    def __init__(self, settings: ReplaySettings) -> None:
        """Open the recording.

        Raises:
            TouchlineError: no such file, not a recording, damaged, or without a given time, event or key.
        """
        if settings.follow and settings.loop:
            raise TouchlineError("--follow and --loop exclude each other: a match that goes on has no end to loop at")
        self.settings = settings
        self._recording = open_recording(settings.file)
        self.cursor = Cursor(settings.file, settings.selection.includes)
        if self._recording.complete and not self.cursor.is_closed:
            raise TouchlineError(
                f"{settings.file}: damaged inside (its records cannot be followed); use another copy of it"
            )
        _check(settings.selection, [channel.key for channel in self._recording.channels])
        self.span = self._span()

    @property
    def recording(self) -> Recording:
        """The recording, as far as it has been written.

        Raises:
            TouchlineError: a file is damaged.
        """
        if not self._recording.complete:
            self._recording = open_recording(self.settings.file)
        return self._recording

    def time_of(self, target: str) -> float:
        """The simulated time in s of a seek target, `12.5`, `tick:625` or `goal:2`.

        Raises:
            TouchlineError: the recording does not have this target.
        """
        return time_in(target, self.recording)

    def events(self) -> list[GameEvent]:
        """All events of the recording, as far as they have been written.

        Raises:
            TouchlineError: the file is damaged inside.
        """
        return [event for _, event in self.recording.decoded(EVENT.key)]

    def player(self, clock: Clock, **more: Callable[..., object]) -> Player:
        """A player of this replay; `more` is `publish` and `can_publish`."""
        settings = self.settings
        rate = AS_FAST_AS_POSSIBLE if settings.rate is None else settings.rate
        return Player(
            self.cursor,
            clock,
            span=self.span,
            rate=rate,
            paused=settings.paused,
            loop=settings.loop,
            stay=settings.stay,
            follow=settings.follow,
            time_of=self.time_of,
            events=self.events,
            **more,  # type: ignore[arg-type]
        )

    def _span(self) -> PlaybackRange:
        settings, cursor = self.settings, self.cursor
        start_ns = cursor.start_ns
        if settings.start is not None:
            start_ns = max(start_ns, round(self.time_of(settings.start) * 1e9))
        elif settings.follow:
            start_ns = max(start_ns, cursor.end_ns - round(settings.behind * 1e9))
        end_ns = round(self.time_of(settings.end) * 1e9) if settings.end is not None else None
        if not settings.follow and start_ns > cursor.end_ns:
            extent = f"the recording, {cursor.start_ns / 1e9:.2f} to {cursor.end_ns / 1e9:.2f} s"
            raise TouchlineError(f"--from {settings.start} is after the end of {extent}; begin earlier")
        if end_ns is not None and end_ns < start_ns:
            raise TouchlineError(f"--to {settings.end} is before the beginning at {start_ns / 1e9:.2f} s; end later")
        return PlaybackRange(start_ns, end_ns)


def _check(selection: KeySelection, keys: Sequence[str]) -> None:
    """Make sure that each expression matches a key.

    Raises:
        TouchlineError: an expression matches no key of the recording.
    """
    for option, expressions in (("--include", selection.include), ("--exclude", selection.exclude)):
        for expression in expressions:
            if not any(matches(expression, key) for key in keys):
                known = did_you_mean(expression, keys)
                raise TouchlineError(f'{option} "{expression}" matches no key of the recording; {known}')
