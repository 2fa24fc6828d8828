"""`touchline health`: what became of every sight and command of each robot, live or recorded."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from runtime.bus.settings import ClientSettings
from runtime.process.timing import REQUEST_S
from schemas.errors import TouchlineError
from touchline.commands.cli import options
from touchline.commands.cli.bus_client import bus_client
from touchline.commands.cli.option_groups import with_option_groups
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from rich.console import Console

    from touchline.commands.diagnosis.health.ledger import Ledger

_PLAIN_WIDTH = 200
"""Width of the table in cells where the output is no terminal: no row is broken."""
_PLAIN_EVERY_S = 1.0
"""Simulated time between two tables of `--watch` where the output is no terminal, in s."""


@with_option_groups
def health(
    file: Annotated[
        Path | None, typer.Argument(metavar="[FILE]", help="A recording, *.mcap; without one, the running match.")
    ] = None,
    watch: Annotated[bool, typer.Option("--watch", help="Show every report until the host ends or Ctrl-C.")] = False,
    doctor: Annotated[
        bool,
        typer.Option(
            "--doctor",
            help="Examine this machine and the way to a host instead: port, certificate, credentials, version, clock.",
        ),
    ] = False,
    start: options.From = None,
    end: options.To = None,
    json: options.Json = False,
    *,
    connection: ClientSettings,
) -> None:
    """Show for each robot: answers on time, late, double and missing, losses each way, latency, radio.

    Counts are those since the match began, of a recording those from --from to --to. docs/networking.md explains each
    column.

    With --doctor it says what works between this machine and a host, what does not, and what to do; the exit status is
    1 if a line failed. Without --connect it examines this machine, and the match that runs on it.

    Example: touchline health --watch

    Example: touchline health --doctor --connect tcp/192.168.1.5:7447
    """
    if doctor:
        if file is not None or watch or start is not None or end is not None:
            raise TouchlineError("--doctor examines machine and way; leave the file, --watch, --from and --to out")
        from touchline.commands.doctor import examine_and_print

        raise typer.Exit(examine_and_print(connection, json=json))
    if file is not None:
        if watch or connection.connect is not None or connection.match is not None:
            raise TouchlineError("--watch, --connect and --match are for a running match; leave them out with a file")
        from touchline.commands.diagnosis.health.recorded import ledger_of_recording

        options.check_span(start, end)
        _show(ledger_of_recording(file, start, end), json=json)
        return
    if start is not None or end is not None:
        raise TouchlineError("--from and --to are for a recording; give its file")
    from touchline.commands.diagnosis.health.live import LiveLedgers

    with bus_client(connection) as bus:
        ledgers = LiveLedgers(bus, REQUEST_S)
        if not watch:
            _show(ledgers.newest(), json=json)
            return
        try:
            _watch(ledgers.all(), json=json)
        except KeyboardInterrupt:
            return
    typer.echo("the host is gone", err=True)


def _show(ledger: "Ledger", *, json: bool) -> None:
    if json:
        typer.echo(json_text(ledger))
        return
    from touchline.commands.diagnosis.health.tables import ledger_view

    _console().print(ledger_view(ledger))


def _watch(ledgers: "Iterator[Ledger]", *, json: bool) -> None:
    """Show one ledger after another: in place on a terminal, otherwise one below the other."""
    if json or not sys.stdout.isatty():
        shown_at = None
        for ledger in ledgers:
            if json or shown_at is None or ledger.end - shown_at >= _PLAIN_EVERY_S:
                shown_at = ledger.end
                _show(ledger, json=json)
                sys.stdout.flush()
        return
    from rich.live import Live

    from touchline.commands.diagnosis.health.tables import ledger_view

    with Live(console=_console(), auto_refresh=False) as live:
        for ledger in ledgers:
            live.update(ledger_view(ledger), refresh=True)


def _console() -> "Console":
    from touchline.launch.terminal.console import console

    made = console()
    if not made.is_terminal:
        made.width = _PLAIN_WIDTH
    return made
