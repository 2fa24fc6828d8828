"""Progress of many matches on stderr: a bar on a terminal, otherwise one line for each match, as text or as JSON.

A match that fails shows its reason at once in all three.
"""

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol

from runtime.process.clock import WallClock
from touchline.launch.terminal.console import console
from touchline.matches.engine.run_counts import RunCounts


class ProgressDisplay(Protocol):
    """What is shown while matches are played."""

    def planned(self, done: int, due: int, failed: int = 0) -> None:
        """Show that `done` matches have ended, `failed` of them not to their end, and `due` can be played now.

        Those that are being played are due.
        """

    def ended(self, sentence: str, *, failed: bool = False) -> None:
        """Show one sentence on a match that has ended; `failed` if it was not played to its end."""


@contextmanager
def progress_of(title: str, *, at_once: int = 1, json: bool = False) -> Iterator[ProgressDisplay]:
    """Yields what shows the progress; no match is known before `planned` is called.

    Args:
        title: of the bar.
        at_once: most matches that are played at a time.
        json: write one JSON object for each match.
    """
    counts = RunCounts(WallClock(), at_once)
    if json:
        yield _Lines(counts, _json_line)
    elif not sys.stderr.isatty():
        yield _Lines(counts, _text_line)
    else:
        with _bar(counts, title) as bar:
            yield bar


class _Lines:
    """One line on stderr for each match."""

    def __init__(self, counts: RunCounts, line_of: Callable[[RunCounts, str, bool], str]) -> None:
        self._counts = counts
        self._line_of = line_of

    def planned(self, done: int, due: int, failed: int = 0) -> None:
        self._counts.plan(done, due, failed)

    def ended(self, sentence: str, *, failed: bool = False) -> None:
        self._counts.add(failed=failed)
        sys.stderr.write(self._line_of(self._counts, sentence, failed) + "\n")
        sys.stderr.flush()


def _text_line(counts: RunCounts, sentence: str, failed: bool) -> str:
    del failed
    text = f"   ({counts.text})" if counts.text else ""
    return f"{counts.done}/{counts.total} {sentence}{text}"


def _json_line(counts: RunCounts, sentence: str, failed: bool) -> str:
    remaining = counts.remaining
    content = {
        "done": counts.done,
        "total": counts.total,
        "running": counts.running,
        "failed": counts.failed,
        "remaining": round(remaining, 1) if remaining is not None else None,
        "match": sentence,
        "match_failed": failed,
    }
    return json.dumps(content, ensure_ascii=False)


@contextmanager
def _bar(counts: RunCounts, title: str) -> Iterator[ProgressDisplay]:
    from rich import progress as rich_progress
    from rich.table import Column
    from rich.text import Text

    class CountsColumn(rich_progress.ProgressColumn):
        """Running and failed matches, and the estimated end."""

        def render(self, task: rich_progress.Task) -> Text:
            del task
            return Text(counts.text, "red" if counts.failed else "")

    class Bar:
        """A bar, above it the matches that failed."""

        def planned(self, done: int, due: int, failed: int = 0) -> None:
            counts.plan(done, due, failed)
            bar.update(task, total=counts.total, completed=counts.done)

        def ended(self, sentence: str, *, failed: bool = False) -> None:
            counts.add(failed=failed)
            if failed:
                bar.console.print(Text(sentence, "red"))
            last = "" if failed else sentence
            bar.update(task, total=counts.total, completed=counts.done, last=last)

    columns = (
        rich_progress.TextColumn("{task.description}", markup=False),
        rich_progress.BarColumn(20),
        rich_progress.MofNCompleteColumn(),
        CountsColumn(),
        rich_progress.TextColumn(
            "{task.fields[last]}", markup=False, table_column=Column(ratio=1, no_wrap=True, overflow="ellipsis")
        ),
    )
    with rich_progress.Progress(*columns, console=console(sys.stderr), expand=True) as bar:
        task = bar.add_task(title, total=counts.total, last="")
        yield Bar()
