"""`touchline new`: makes the folder of a new team, which plays at once."""

from pathlib import Path
from typing import Annotated

import typer

from touchline.team.new_team import class_name, make_team


def new(
    name: Annotated[str, typer.Argument(help="Lower-case letters, digits and _; the folder and its module get it.")],
    folder: Annotated[Path, typer.Option("--in", help="Where the folder is made.", file_okay=False)] = Path(),
) -> None:
    """Make a folder with a team that plays: brain, match file, test and README.

    Example: touchline new my_team
    """
    made = make_team(name, folder)
    typer.echo(f"{made}: a team of five, {class_name(name)}")
    typer.echo(f"plays:  cd {made}; touchline match match.toml")
    typer.echo("tests:  pytest")
