"""`touchline info`: the contents of a recording."""

from pathlib import Path
from typing import Annotated

import typer

from touchline.commands.cli import options
from touchline.launch.terminal.json_text import json_text


def info(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The recording, *.mcap.")],
    json: options.Json = False,
) -> None:
    """Show the contents of a recording: match, result, keys and lost messages.

    Example: touchline info runs/friendly-20260101T120000Z-seed1/match.mcap
    """
    from recordings.inspection.facts_table import HEADINGS, key_rows, summary_lines
    from recordings.inspection.recording_facts import facts_of
    from recordings.reading.recording import open_recording

    facts = facts_of(open_recording(file))
    if json:
        typer.echo(json_text(facts))
        return
    from rich.table import Table

    from touchline.launch.terminal.console import console as new_console
    from touchline.launch.terminal.console import table

    console = new_console()
    about = Table.grid(padding=(0, 2))
    for name, value in summary_lines(facts):
        about.add_row(name, value)
    console.print(about)
    console.print()
    console.print(table(HEADINGS, key_rows(facts), names=2))
