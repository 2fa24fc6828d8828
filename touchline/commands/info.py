"""`touchline info`: the contents of a recording."""

from pathlib import Path
from typing import Annotated

import typer

from touchline.commands.cli import options
from touchline.launch.terminal.json_text import json_text


def info(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE...", help="The recording, or any *.mcap files and bag folders.")
    ],
    json: options.Json = False,
) -> None:
    """Show the contents of a recording: match, result, keys and lost messages; of any other MCAP, its channels.

    Example: touchline info runs/friendly-20260101T120000Z-seed1/match.mcap
    """
    from recordings.inspection.facts_table import HEADINGS, key_rows, summary_lines
    from recordings.inspection.log_facts import HEADINGS as CHANNEL_HEADINGS
    from recordings.inspection.log_facts import LogFacts, channel_rows, log_facts, log_lines
    from recordings.inspection.recording_facts import facts_of
    from recordings.reading.log_order import is_match
    from recordings.reading.recording import open_recording

    facts = facts_of(open_recording(files[0])) if is_match(files) else log_facts(files)
    if json:
        typer.echo(json_text(facts))
        return
    from rich.table import Table

    from touchline.launch.terminal.console import console as new_console
    from touchline.launch.terminal.console import table

    console = new_console()
    about = Table.grid(padding=(0, 2))
    for name, value in log_lines(facts) if isinstance(facts, LogFacts) else summary_lines(facts):
        about.add_row(name, value)
    console.print(about)
    console.print()
    if isinstance(facts, LogFacts):
        console.print(table(CHANNEL_HEADINGS, channel_rows(facts), names=3))
    else:
        console.print(table(HEADINGS, key_rows(facts), names=2))
