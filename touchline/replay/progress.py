"""Progress display of a replay: a progress bar on a terminal, otherwise a plain line at intervals."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol, TextIO

from rich.progress import BarColumn, Progress, TextColumn

from schemas.messages.replay import ReplayReply
from schemas.process.clock import Clock
from touchline.cli.console import console
from touchline.timing import LINE_S, REFRESH_S


class ProgressDisplay(Protocol):
    """Shows the status of a replay."""

    def __call__(self, status: ReplayReply) -> None:
        """Show this status; some calls may be skipped."""


def status_text(status: ReplayReply) -> str:
    """A status as text: `0:24.7 of 0:28.0  ×2  paused  loop`."""
    speed = "as fast as possible" if status.rate is None else f"×{status.rate:g}"
    parts = [f"{_minutes(status.time)} of {_minutes(status.end)}", speed]
    return "  ".join([*parts, *(name for name, is_on in (("paused", status.paused), ("loop", status.loop)) if is_on)])


def _minutes(seconds: float) -> str:
    minutes, rest = divmod(max(0.0, round(seconds, 1)), 60)
    return f"{int(minutes)}:{rest:04.1f}"


@contextmanager
def progress_on(stream: TextIO, clock: Clock) -> Iterator[ProgressDisplay]:
    """The display for a stream."""
    if not stream.isatty():
        yield _lines(stream, clock)
        return
    columns = (BarColumn(bar_width=None), TextColumn("{task.description}", markup=False))
    with Progress(*columns, console=console(stream), auto_refresh=False) as bar:
        yield _bar(bar, clock)


def _bar(bar: Progress, clock: Clock) -> ProgressDisplay:
    task = bar.add_task("", total=1.0)
    shown_at = -REFRESH_S

    def show(status: ReplayReply) -> None:
        nonlocal shown_at
        if clock.now() - shown_at >= REFRESH_S:
            shown_at = clock.now()
            total = max(status.end - status.start, 1e-9)
            bar.update(
                task, total=total, completed=status.time - status.start, description=status_text(status), refresh=True
            )

    return show


def _lines(stream: TextIO, clock: Clock) -> ProgressDisplay:
    shown_at = -LINE_S

    def show(status: ReplayReply) -> None:
        nonlocal shown_at
        if clock.now() - shown_at >= LINE_S:
            shown_at = clock.now()
            stream.write(status_text(status) + "\n")
            stream.flush()

    return show
