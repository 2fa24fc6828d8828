"""The `touchline` command line: every command, each in a file of its own under `commands/`."""

import typer

from touchline.cli.errors import CommandGroup
from touchline.commands import (
    agent,
    coach,
    diff,
    drive,
    export,
    filter,
    host,
    import_log,
    info,
    match,
    merge,
    parameters,
    player,
    record,
    recorder,
    recover,
    replay,
    scene,
    scenes,
    schema,
    stats,
    topics,
    verify,
    watch,
)

app = typer.Typer(
    name="touchline",
    cls=CommandGroup,
    help="A testbed for teams of robots: play a match, or run its parts on several machines.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

app.command("match")(match.match)
app.command("host")(host.host)
app.command("agent")(agent.agent)
app.add_typer(coach.app, name="coach")
app.command("watch")(watch.watch)
app.add_typer(parameters.app, name="parameters")
app.add_typer(scene.app, name="scene")
app.command("scenes")(scenes.scenes)
app.command("drive")(drive.drive)
app.command("record")(record.record)
app.add_typer(recorder.app, name="recorder")
app.command("replay")(replay.replay)
app.command("player")(player.player)
app.command("info")(info.info)
app.command("recover")(recover.recover)
app.command("diff")(diff.diff)
app.command("filter")(filter.filter)
app.command("merge")(merge.merge)
app.command("stats")(stats.stats)
app.command("export")(export.export)
app.command("import")(import_log.import_log)
app.command("verify")(verify.verify)
app.command("topics")(topics.topics)
app.command("schema")(schema.schema)


def main() -> None:
    """Run the command line; exits with its status."""
    app(prog_name="touchline")


if __name__ == "__main__":
    main()
