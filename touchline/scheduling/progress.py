"""Progress of many matches on stderr: a bar on a terminal, otherwise one line for each match."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from touchline.cli.console import console


@contextmanager
def progress_of(total: int, title: str) -> Iterator[Callable[[str], None]]:
    """Yields a function to call with one sentence for each match that has ended."""
    if not sys.stderr.isatty():
        ended = 0

        def report(sentence: str) -> None:
            nonlocal ended
            ended += 1
            sys.stderr.write(f"{ended}/{total} {sentence}\n")
            sys.stderr.flush()

        yield report
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console(sys.stderr)) as progress:
        task = progress.add_task(title, total=total)

        def show(sentence: str) -> None:
            progress.update(task, advance=1, description=sentence)

        yield show
