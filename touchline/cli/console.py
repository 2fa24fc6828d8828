"""The console of the commands: names and texts from users and programs are printed verbatim."""

from typing import TextIO

from rich.console import Console


def console(file: TextIO | None = None) -> Console:
    """A console without markup, highlighting and emoji: a team may have the name [b], and a coach the name `:cat:`."""
    return Console(file=file, highlight=False, markup=False, emoji=False)
