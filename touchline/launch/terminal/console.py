"""The console of the commands: names and texts from users and programs are printed verbatim."""

from collections.abc import Iterable, Sequence
from typing import TextIO

from rich.console import Console
from rich.table import Table


def console(file: TextIO | None = None) -> Console:
    """A console without markup, highlighting and emoji: a team may have the name [b], and a coach the name `:cat:`."""
    return Console(file=file, highlight=False, markup=False, emoji=False)


def table(headings: Sequence[str], rows: Iterable[Sequence[str]] = (), names: int = 1) -> Table:
    """A table without a frame: its first columns, as many as `names`, are aligned to the left, others to the right."""
    made = Table(*headings, box=None, pad_edge=False)
    for column in made.columns[names:]:
        column.justify = "right"
    for row in rows:
        made.add_row(*row)
    return made
