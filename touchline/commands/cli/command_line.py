"""The command line: the options that stand before a command. `table.py` lists the commands."""

import signal
import sys
from io import TextIOWrapper
from typing import Annotated

import typer

from touchline.commands.cli.table import TouchlineGroup
from touchline.commands.cli.version import version_text


def _print_version(value: bool) -> None:
    """Print the versions of this library and of its protocol, and exit, if the option is given."""
    if value:
        typer.echo(version_text())
        raise typer.Exit()


app = typer.Typer(
    name="touchline",
    cls=TouchlineGroup,
    help="A testbed for teams of robots: play a match, or run its parts on several machines.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version and exit.", is_eager=True, callback=_print_version)
    ] = False,
) -> None:
    """Options of the command line itself."""


def main() -> None:
    """Run the command line; exits with its status, after Ctrl-C as a process that SIGINT ended."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")  # ? for what the terminal's encoding has not
    try:
        app(prog_name="touchline")
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)
