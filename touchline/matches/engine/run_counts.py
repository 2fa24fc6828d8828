"""How far a run of many matches is, and when it will end."""

from dataclasses import dataclass
from datetime import datetime, timedelta

from runtime.process.clock import Clock


@dataclass(slots=True)
class RunCounts:
    """Counts of matches; those that had ended before this run began are done, too."""

    clock: Clock
    at_once: int = 1
    """Most matches that are played at a time."""
    due: int = 0
    """Matches that can be played now, with those that are being played."""
    done: int = 0
    failed: int = 0
    """Those of `done` that were not played to their end."""
    ended: int = 0
    """Those of `done` that have ended in this run."""
    began: float = 0.0
    """Wall time of its beginning, s."""

    def __post_init__(self) -> None:
        self.began = self.clock.now()

    def plan(self, done: int, due: int, failed: int) -> None:
        """So many matches are there."""
        self.done, self.due, self.failed = done, due, failed

    def add(self, *, failed: bool) -> None:
        """A match has ended."""
        self.done += 1
        self.ended += 1
        self.due = max(0, self.due - 1)
        self.failed += failed

    @property
    def total(self) -> int:
        """All matches that are known."""
        return self.done + self.due

    @property
    def running(self) -> int:
        """Matches that are being played."""
        return min(self.due, self.at_once)

    @property
    def remaining(self) -> float | None:
        """Wall time until all known matches have ended, in s, if they end as those before; None before the first."""
        return (self.clock.now() - self.began) / self.ended * self.due if self.ended else None

    @property
    def text(self) -> str:
        """Running and failed matches and the estimated end, as `2 running, 1 failed, ends 14:32`; empty at the end."""
        parts = [f"{self.running} running"] if self.due else []
        parts += [f"{self.failed} failed"] if self.failed else []
        if self.due and self.remaining is not None:
            parts.append(f"ends {self._end(self.remaining)}")
        return ", ".join(parts)

    def _end(self, remaining: float) -> str:
        """Clock time so many s from now; with the date if that is another day."""
        now = datetime.fromtimestamp(self.clock.unix_ns() / 1e9)
        end = now + timedelta(seconds=remaining)
        return f"{end:%H:%M}" if end.date() == now.date() else f"{end:%d %b %H:%M}"
