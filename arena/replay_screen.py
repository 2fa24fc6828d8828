"""Where a replay is shown: a progress bar on a terminal, a plain line now and then everywhere else."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol, TextIO

from rich.progress import BarColumn, Progress, TextColumn

from arena.console import console
from schemas.clock import Clock
from schemas.replay import ReplayReply

LINE_EVERY = 5.0
"""s of wall time between lines where nothing can be overwritten."""
_BAR_EVERY = 0.1
"""s of wall time between two pictures of the bar."""


class ReplayScreen(Protocol):
    """Shows how a replay stands."""

    def __call__(self, status: ReplayReply) -> None:
        """It stands like this; may be shown or not."""


def words(status: ReplayReply) -> str:
    """`0:24.7 of 0:28.0  ×2  paused  loop`."""
    speed = "as fast as possible" if status.rate is None else f"×{status.rate:g}"
    parts = [f"{_minutes(status.time)} of {_minutes(status.end)}", speed]
    return "  ".join([*parts, *(word for word, said in (("paused", status.paused), ("loop", status.loop)) if said)])


def _minutes(seconds: float) -> str:
    minutes, rest = divmod(max(0.0, round(seconds, 1)), 60)
    return f"{int(minutes)}:{rest:04.1f}"


@contextmanager
def screen_on(stream: TextIO, clock: Clock) -> Iterator[ReplayScreen]:
    """The screen that suits a stream."""
    if not stream.isatty():
        yield _lines(stream, clock)
        return
    columns = (BarColumn(bar_width=None), TextColumn("{task.description}", markup=False))
    with Progress(*columns, console=console(stream), auto_refresh=False) as bar:
        yield _bar(bar, clock)


def _bar(bar: Progress, clock: Clock) -> ReplayScreen:
    task = bar.add_task("", total=1.0)
    shown_at = -_BAR_EVERY

    def show(status: ReplayReply) -> None:
        nonlocal shown_at
        if clock.now() - shown_at >= _BAR_EVERY:
            shown_at = clock.now()
            total = max(status.end - status.start, 1e-9)
            bar.update(task, total=total, completed=status.time - status.start, description=words(status), refresh=True)

    return show


def _lines(stream: TextIO, clock: Clock) -> ReplayScreen:
    shown_at = -LINE_EVERY

    def show(status: ReplayReply) -> None:
        nonlocal shown_at
        if clock.now() - shown_at >= LINE_EVERY:
            shown_at = clock.now()
            stream.write(words(status) + "\n")
            stream.flush()

    return show
