"""`touchline match`: a whole match on this machine, from its file to its result."""

import shutil
import sys
from dataclasses import replace
from pathlib import Path
from socket import socket
from typing import TYPE_CHECKING, Annotated, Any

import typer

from coach_gateway.settings import BridgeOptions
from runtime.access.certificates import need_trustme
from runtime.bus.endpoint import ENCRYPTED, parse_endpoint
from runtime.bus.settings import ListenSettings
from runtime.process.clock import Clock, WallClock
from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import Patience
from schemas.config.settings import RecordOptions
from schemas.errors import MatchFailedError, TouchlineError
from schemas.side import Side
from touchline.commands.cli import options
from touchline.commands.cli.option_groups import FieldsOf, from_options, with_option_groups

if TYPE_CHECKING:
    from touchline.launch.processes.programs import MatchPlan, Page


@with_option_groups
def match(
    record: Annotated[Path | None, typer.Option(help="The recording to write; by default in the run's folder.")] = None,
    no_record: Annotated[bool, typer.Option("--no-record", help="Do not record the match.")] = False,
    ghost: Annotated[
        list[str] | None, typer.Option(help="A side played by its recorded commands: magenta=RECORDING.mcap.")
    ] = None,
    remote: Annotated[
        Side | None, typer.Option(help="This side's robots join from another machine, with touchline team.")
    ] = None,
    tls: Annotated[
        bool, typer.Option("--tls", help="Encrypt all connections, with a certificate made for this match.")
    ] = False,
    reload: Annotated[
        bool, typer.Option("--reload", help="Build brains anew between two episodes if their code has changed.")
    ] = False,
    web: options.Web = False,
    json: options.Json = False,
    *,
    isolation: Annotated[dict[str, Any], FieldsOf(MatchConfig, "isolate")],
    played: options.MatchOptions,
    waiting: Annotated[dict[str, Any], FieldsOf(Patience, remote="wait")],
    recording: Annotated[dict[str, Any], FieldsOf(RecordOptions)],
    page: options.PageOptions,
    bridges: BridgeOptions,
) -> None:
    """Play a match: launch host, recorder and robots, show the match, and write a recording and a result.

    Logs and recording are written under ./runs/. Ctrl-C ends all processes; the recording stays readable.
    --web serves a page to watch and command the match in a browser. --udp, --refbox and --refbox-server connect coach
    programs, league boxes and team software. With any of these the default of --pace is realtime. With --refbox the
    default of --referee is manual, because the league's box decides.
    With --reload, brains that were edited play on from the next `touchline scene reset`.
    With --remote, or a remote team in the match file, the match waits for that team and prints how it joins.

    Example: touchline match --seed 7 --duration 60 --pace realtime
    """
    from touchline.launch.check_brains import check_reload, check_teams
    from touchline.launch.confinement.robot_confinement import isolation_note, team_confinements
    from touchline.launch.processes.programs import CREDENTIALS, check_robot_names
    from touchline.launch.run_folder import RUNS, prepare_credentials, prepare_run, with_credentials

    if no_record and record is not None:
        raise TouchlineError(f"--record {record} and --no-record exclude each other; leave one of them out")
    teams: dict[str, Any] = {}
    if ghost:
        from touchline.play.ghost import check_ghosts, teams_of

        teams = teams_of(ghost)
    sockets: tuple[socket, ...] = ()
    if bridges.wanted:
        from coach_gateway.bridges import bridges_of

        sockets = tuple(bridges_of(bridges).open_ports())
    if web or bridges.wanted:
        played.changes.setdefault("pace", "realtime")
    if bridges.refbox is not None:
        played.officiating.setdefault("mode", "manual")  # the league's box decides
    config = played.read(
        **{f"teams__{side}": team for side, team in teams.items()},
        **({f"teams__{remote}__remote": True} if remote is not None else {}),
        **{f"patience__{key}": value for key, value in waiting.items()},
        **{f"record__{key}": value for key, value in recording.items()},
        record__wait=not no_record,
        **isolation,
    )
    if ghost:
        check_ghosts(config, ghost)
    check_robot_names(config)
    if reload:
        check_reload(config)
    endpoint = _endpoint(played.listening, tls=tls)
    _check_tls(played.listening, tls=tls)
    brain_folder = played.file.parent if played.file is not None else None
    confinements = team_confinements(config, brain_folder, RUNS)
    check_teams(config, brain_folder, lambda line: typer.echo(line, err=True), confinements)
    clock = WallClock()
    served: Page | None = None
    if web:
        from coach_gateway.web.settings import WebSettings
        from touchline.launch.page import open_page

        served = open_page(from_options(WebSettings, **page))
    plan = prepare_run(config, endpoint, record, clock, recorded=not no_record)
    plan = replace(plan, page=served, bridges=bridges, bridge_sockets=sockets, confinements=confinements)
    plan = replace(plan, reload=reload, isolation_note=isolation_note(config, brain_folder))
    if played.listening.credentials is not None:
        plan = with_credentials(plan, played.listening.credentials.resolve().parent)
    elif not played.listening.insecure:
        plan = prepare_credentials(plan, tls=tls)
    if brain_folder is not None:
        plan = replace(plan, brain_folder=brain_folder.resolve())
    if bridges.wanted:
        typer.echo(f"bridges: {plan.folder / 'bridges.log'}; the coaches' tokens: {plan.tokens}", err=json)
    if plan.warning:
        typer.echo(f"touchline: {plan.warning}", err=True)
    try:
        _play(plan, clock, quiet=json)
    finally:
        shutil.rmtree(plan.folder / CREDENTIALS, ignore_errors=True)  # they are of no use after the match


# Modules that a plain match does not need are imported on use: no process is launched before the imports are done.


def _endpoint(listening: ListenSettings, *, tls: bool) -> str | None:
    """The endpoint to listen on. Others may reach it: a match that is given no credentials makes its own.

    Raises:
        TouchlineError: it needs a certificate, and none is to be made.
    """
    makes_own = listening.credentials is None and not listening.insecure
    needs_tls = listening.listen is not None and parse_endpoint(listening.listen)[0] in ENCRYPTED
    return listening.listen if makes_own and (tls or not needs_tls) else options.endpoint_of(listening)


def _check_tls(listening: ListenSettings, *, tls: bool) -> None:
    """Check that a certificate can be made for this match alone.

    Raises:
        TouchlineError: the match has credentials of its own, or none at all; or the package is missing.
    """
    if not tls:
        return
    if listening.credentials is not None or listening.insecure:
        other = "--credentials" if listening.credentials is not None else "--insecure"
        raise TouchlineError(
            f"--tls is for credentials that the match makes itself, not for {other}; "
            "`touchline credentials new --tls` makes credentials with TLS"
        )
    need_trustme()


def _play(plan: "MatchPlan", clock: Clock, *, quiet: bool) -> None:
    """Play the match on a screen for the output, and print its result; with `quiet` stdout has the JSON result alone.

    With a page it returns when the page with the result is closed.
    """
    from touchline.launch.match_run import InterruptedMatchError, MatchRun
    from touchline.launch.terminal.agent_faults import disturbance
    from touchline.launch.terminal.screen import screen_for

    try:
        with screen_for(sys.stderr if quiet else sys.stdout, clock) as screen:
            run = MatchRun(plan, screen, clock)
            result = run.play()
    except InterruptedMatchError as stopped:
        left = plan.recording is not None and plan.recording.exists()
        typer.echo(f"touchline: match interrupted; see {plan.recording if left else plan.folder}", err=True)
        raise typer.Exit(128 + stopped.number) from None
    if quiet:
        typer.echo(result.json())
    else:
        from touchline.launch.terminal.console import console

        console().print(result.render())
    if plan.page is not None:
        from touchline.launch.match_page import result_parts

        run.stay(result_parts(plan))
    if faults := [fault for fault in (disturbance(result.missed), result.recording.fault) if fault]:
        raise MatchFailedError("\ntouchline: ".join(faults))
