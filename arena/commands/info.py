"""`touchline info`: what is in a recording."""

import json as json_text
from pathlib import Path
from typing import Annotated

import typer

from arena import options


def info(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The recording, *.mcap.")],
    json: options.Json = False,
) -> None:
    """Show what is in a recording: match, result, keys and losses.

    Example: touchline info runs/friendly-20260101T120000Z-seed1/match.mcap
    """
    from recordings.info import HEADINGS, facts_of, lines, rows
    from recordings.reader import open_recording

    facts = facts_of(open_recording(file))
    if json:
        typer.echo(json_text.dumps(facts.to_json(), ensure_ascii=False))
        return
    from rich.table import Table

    from arena.console import console as new_console

    console = new_console()
    about = Table.grid(padding=(0, 2))
    for name, value in lines(facts):
        about.add_row(name, value)
    table = Table(*HEADINGS, box=None, pad_edge=False)
    for column in table.columns[2:]:
        column.justify = "right"
    for row in rows(facts):
        table.add_row(*row)
    console.print(about)
    console.print()
    console.print(table)
