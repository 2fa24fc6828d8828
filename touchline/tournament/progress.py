"""Progress of a cup on stderr: a bar on a terminal, otherwise one line for each match that has ended."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from touchline.cli.console import console
from touchline.tournament.cup_state import CupState, MatchState

Report = Callable[[CupState, str], None]
"""Called with the state of the cup, and one sentence on the match that has ended."""


@contextmanager
def progress_of(state: CupState) -> Iterator[Report]:
    """Yields the function to call; the number of known matches grows with the rounds."""
    if not sys.stderr.isatty():
        yield _print_line
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (BarColumn(), MofNCompleteColumn(), TimeRemainingColumn(), TextColumn("{task.description}", markup=False))
    with Progress(*columns, console=console(sys.stderr)) as progress:
        task = progress.add_task(state.cup.title or state.cup.name, total=len(state.matches), completed=_over(state))

        def show(now: CupState, sentence: str) -> None:
            progress.console.print(sentence, markup=False, highlight=False)
            failed = f"{len(now.failed)} failed" if now.failed else ""
            progress.update(task, total=len(now.matches), completed=_over(now), description=failed)

        yield show


def _print_line(state: CupState, sentence: str) -> None:
    sys.stderr.write(f"{_over(state)}/{len(state.matches)} {sentence}\n")
    sys.stderr.flush()


def _over(state: CupState) -> int:
    return sum(one.state is not MatchState.DUE for one in state.matches)
