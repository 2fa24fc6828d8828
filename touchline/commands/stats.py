"""`touchline stats`: statistics of a match, as text, JSON or an HTML page."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from schemas.side import Side
from touchline.commands.cli import options
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from recordings.soccer.stats.figures import MatchFigures


def stats(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="The recording, *.mcap.")],
    json: options.Json = False,
    html: Annotated[
        Path | None, typer.Option(metavar="PAGE.html", help="Write the statistics as one self-contained HTML page.")
    ] = None,
) -> None:
    """Measure a match: score, possession, passes, shots, saves, distance, speed, fouls, restarts.

    Example: touchline stats match.mcap --html match.html
    """
    from recordings.reading.recording import open_recording
    from recordings.soccer.stats.match_statistics import figures_of_recording
    from recordings.soccer.stats.page import page_of, write_page

    recording = open_recording(file)
    if html is not None:
        figures, text = page_of(recording)
        write_page(html, text)
    else:
        figures = figures_of_recording(recording)
    if json:
        typer.echo(json_text(figures.to_json()))
        return
    _show(figures)
    if html is not None:
        typer.echo(f"page  {html}")


def _show(figures: "MatchFigures") -> None:
    from recordings.soccer.stats.table import ROBOT_HEADINGS, headline, remarks, robot_rows, side_rows
    from touchline.launch.terminal.console import console as new_console
    from touchline.launch.terminal.console import table

    console = new_console()
    console.print(headline(figures), style="bold")
    for headings, rows in ((("", *Side), side_rows(figures)), (ROBOT_HEADINGS, robot_rows(figures))):
        shown = table(headings, rows)
        shown.columns[0].no_wrap = True
        console.print()
        console.print(shown)
    for remark in remarks(figures):
        console.print(remark, style="yellow")
