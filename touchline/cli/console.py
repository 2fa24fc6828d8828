"""The console that commands print on: what people and programs have named or written is shown as it is."""

from typing import TextIO

from rich.console import Console


def console(file: TextIO | None = None) -> Console:
    """One that takes no word for markup, number or emoji: a team may be called [b], and a coach may ask as `:cat:`."""
    return Console(file=file, highlight=False, markup=False, emoji=False)
