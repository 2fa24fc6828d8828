"""What is to be replayed, and how: a file or one that is still written, from where to where, which keys."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from recordings.container.key_selection import EVERYTHING, KeySelection, key_pattern
from recordings.reading.recording import Recording
from recordings.reading.split_cursor import SplitCursor
from recordings.replay.playback_clock import AS_FAST_AS_POSSIBLE
from recordings.replay.player import PlaybackRange, Player
from recordings.replay.seek_targets import SeekTarget, seek_targets_of, time_of
from schemas.errors import TouchlineError, did_you_mean
from schemas.game import GameEvent
from schemas.process.clock import Clock
from schemas.topics import EVENT


@dataclass(frozen=True, slots=True)
class ReplaySettings:
    """What somebody asked for."""

    file: Path
    start: str | None = None
    """Seconds or an event; from the beginning when not given."""
    end: str | None = None
    rate: float | None = 1.0
    """Simulated seconds per wall second; as fast as possible when nothing."""
    loop: bool = False
    paused: bool = False
    stay: bool = False
    """Stand still at the end instead of ending."""
    selection: KeySelection = EVERYTHING
    """Which keys are played."""
    follow: bool = False
    """The file is still being written, and those that may come after it."""
    behind: float = 5.0
    """Following: where to begin, s of simulated time before the newest."""


class Replay:
    """A recording that is open for replay."""

    def __init__(self, settings: ReplaySettings) -> None:
        """Open it.

        Raises:
            TouchlineError: no such file, not a recording, damaged, a moment or a key that it does not have.
        """
        if settings.follow and settings.loop:
            raise TouchlineError(
                "--follow and --loop are both given; a match that goes on has no end to begin again at"
            )
        self.settings = settings
        self.cursor = SplitCursor(settings.file, settings.selection.includes, follow=settings.follow)
        self.recording: Recording = self.cursor.recording
        _check(settings.selection, [channel.key for part in self.cursor.recordings for channel in part.channels])
        self.span = self._span()

    def time_of(self, words: str) -> float:
        """The simulated time in s that words name, `12.5` or `goal:2`.

        Raises:
            TouchlineError: it is no moment of this recording.
        """
        return time_of(words, self.seek_targets() if not _is_number(words) else [])

    def seek_targets(self) -> list[SeekTarget]:
        """Everything that can be gone to, as far as it has been written.

        Raises:
            TouchlineError: a file is damaged inside.
        """
        return seek_targets_of(*self.cursor.recordings)

    def events(self) -> list[GameEvent]:
        """All that happens in the recording, as far as it has been written.

        Raises:
            TouchlineError: the file is damaged inside.
        """
        return [event for part in self.cursor.recordings for _, event in part.decoded(EVENT.key)]

    def player(self, clock: Clock, **more: Callable[..., object]) -> Player:
        """A player for it; `more` is `publish` and `can_publish`."""
        wanted = self.settings
        rate = AS_FAST_AS_POSSIBLE if wanted.rate is None else wanted.rate
        return Player(
            self.cursor,
            clock,
            span=self.span,
            rate=rate,
            paused=wanted.paused,
            loop=wanted.loop,
            stay=wanted.stay,
            follow=wanted.follow,
            time_of=self.time_of,
            events=self.events,
            **more,  # type: ignore[arg-type]
        )

    def _span(self) -> PlaybackRange:
        wanted, cursor = self.settings, self.cursor
        start_ns = cursor.start_ns
        if wanted.start is not None:
            start_ns = max(start_ns, round(self.time_of(wanted.start) * 1e9))
        elif wanted.follow:
            start_ns = max(start_ns, cursor.end_ns - round(wanted.behind * 1e9))
        end_ns = round(self.time_of(wanted.end) * 1e9) if wanted.end is not None else None
        if not wanted.follow and start_ns > cursor.end_ns:
            extent = extent_text(cursor.start_ns, cursor.end_ns)
            raise TouchlineError(f"--from {wanted.start} is behind the end of {extent}; begin earlier")
        if end_ns is not None and end_ns < start_ns:
            raise TouchlineError(f"--to {wanted.end} is before the beginning at {start_ns / 1e9:.2f} s; end later")
        return PlaybackRange(start_ns, end_ns)


def extent_text(start_ns: int, end_ns: int) -> str:
    """An extent in words."""
    return f"the recording, {start_ns / 1e9:.2f} to {end_ns / 1e9:.2f} s"


def _is_number(words: str) -> bool:
    try:
        float(words)
    except ValueError:
        return False
    return True


def _check(selection: KeySelection, keys: Sequence[str]) -> None:
    """Make sure that what is chosen is there.

    Raises:
        TouchlineError: an expression that no key of the recording fits.
    """
    for option, expressions in (("--include", selection.include), ("--exclude", selection.exclude)):
        for expression in expressions:
            if not any(key_pattern(expression).fullmatch(key) for key in keys):
                known = did_you_mean(expression, keys)
                raise TouchlineError(f'{option} "{expression}" fits no key of the recording; {known}')
