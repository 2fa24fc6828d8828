"""The table of all commands, each in a file of its own under `commands/`."""

import signal
import sys
from typing import Annotated

import typer

from touchline.commands import (
    agent,
    check,
    coach,
    credentials,
    diff,
    drill,
    experiment,
    export,
    filter,
    health,
    host,
    import_log,
    info,
    match,
    new,
    parameters,
    record,
    recover,
    referee,
    replay,
    scene,
    series,
    stats,
    team,
    topics,
    tournament,
    verify,
    watch,
)
from touchline.commands.cli.errors import CommandGroup
from touchline.commands.cli.version import version_text


def _print_version(value: bool) -> None:
    """Print the versions of this library and of its protocol, and exit, if the option is given."""
    if value:
        typer.echo(version_text())
        raise typer.Exit()


app = typer.Typer(
    name="touchline",
    cls=CommandGroup,
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


PLAY = "Play"
TEAMS = "Build a team"
WATCH = "Watch"
OPERATE = "Operate a running match"
PROCESSES = "Processes on several machines"
RECORDINGS = "Recordings"
PROTOCOL = "Protocol"

app.command("match", rich_help_panel=PLAY)(match.match)

app.command("new", rich_help_panel=TEAMS)(new.new)
app.command("check", rich_help_panel=TEAMS)(check.check)
app.command("drill", rich_help_panel=TEAMS)(drill.drill)
app.command("series", rich_help_panel=TEAMS)(series.series)
app.command("tournament", rich_help_panel=TEAMS)(tournament.tournament)
app.add_typer(experiment.app, name="experiment", rich_help_panel=TEAMS)

app.command("watch", rich_help_panel=WATCH)(watch.watch)
app.command("health", rich_help_panel=WATCH)(health.health)
app.command("replay", rich_help_panel=WATCH)(replay.replay)

app.add_typer(coach.app, name="coach", rich_help_panel=OPERATE)
app.add_typer(referee.app, name="referee", rich_help_panel=OPERATE)
app.add_typer(scene.app, name="scene", rich_help_panel=OPERATE)
app.add_typer(parameters.app, name="parameters", rich_help_panel=OPERATE)

app.command("host", rich_help_panel=PROCESSES)(host.host)
app.command("agent", rich_help_panel=PROCESSES)(agent.agent)
app.command("team", rich_help_panel=PROCESSES)(team.team)
app.command("record", rich_help_panel=PROCESSES)(record.record)
app.add_typer(credentials.app, name="credentials", rich_help_panel=PROCESSES)

app.command("info", rich_help_panel=RECORDINGS)(info.info)
app.command("stats", rich_help_panel=RECORDINGS)(stats.stats)
app.command("verify", rich_help_panel=RECORDINGS)(verify.verify)
app.command("diff", rich_help_panel=RECORDINGS)(diff.diff)
app.command("filter", rich_help_panel=RECORDINGS)(filter.filter)
app.command("recover", rich_help_panel=RECORDINGS)(recover.recover)
app.command("export", rich_help_panel=RECORDINGS)(export.export)
app.command("import", rich_help_panel=RECORDINGS)(import_log.import_log)

app.command("topics", rich_help_panel=PROTOCOL)(topics.topics)


def main() -> None:
    """Run the command line; exits with its status, after Ctrl-C as a process that SIGINT ended."""
    try:
        app(prog_name="touchline")
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)
