"""`touchline import`: converts a foreign log to a recording."""

from pathlib import Path
from typing import Annotated

import typer

from recordings.exchange import formats
from touchline.commands.cli import options
from touchline.launch.terminal.json_text import json_text


def import_log(
    log: Annotated[list[Path], typer.Argument(metavar="LOG...", help="A zip, a folder, or the log's files.")],
    out: Annotated[Path | None, typer.Option(help="The recording, *.mcap; by default in the log's folder.")] = None,
    profile: Annotated[
        str | None,
        typer.Option(help="Profile of the pitch: msl for 22 × 14 m, paper for 18 × 12 m; recognised by default."),
    ] = None,
    team_a: Annotated[
        str | None, typer.Option("--team-a", help="Name of team A in the referee's signals, if that is an address.")
    ] = None,
    json: options.Json = False,
) -> None:
    """Convert a log of the league's referee box to a recording that can be replayed and measured.

    Example: touchline import 20160703_120000.TeamA-TeamB.zip --out final.mcap
    """
    imported = formats.import_log(log, out or log[0].with_suffix(".mcap"), profile, team_a)
    if json:
        typer.echo(json_text(imported.to_json()))
        return
    for side, team in imported.teams.items():
        typer.echo(f"{side.value}: {team.team or 'no name'}, {team.read} of {team.records} records read")
    typer.echo(f"{imported.signals} referee signals read, {imported.kicks} kicks inferred")
    groups = (
        ("could not be read", imported.lost),
        ("left out, a recording has no place for it", imported.left_out),
        ("read all the same", imported.coped),
    )
    for heading, findings in groups:
        if findings:
            typer.echo(f"{heading}:")
        for finding in findings:
            typer.echo(f"{finding.count:>9}  {finding.what} (first: {finding.first})")
    typer.echo(f"{imported.out}: {imported.result.time:.2f} s, {imported.result.messages} messages")
