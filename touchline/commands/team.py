"""`touchline team`: all robots of one team on this machine, for a host on another."""

import sys
from functools import partial
from typing import Annotated, Any

import typer

from robot_agent.process.settings import AgentSettings
from runtime.access.accounts import Account
from runtime.process.clock import WallClock
from schemas.config.confinement import Limits
from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import TeamConfig, TeamConfigs
from schemas.config.shipped_teams import brain_of
from schemas.errors import TouchlineError
from touchline.commands.cli import options
from touchline.commands.cli.option_groups import FieldsOf, from_options, with_option_groups

_OWN = ("robot", "brain", "stdio", "side")
"""Fields that the command fills itself."""
_SHARED = tuple(name for name in AgentSettings.model_fields if name not in _OWN)


@with_option_groups
def team(
    side: options.ForSide,
    brain: Annotated[
        str | None, typer.Option(help="The robots' brain: a shipped team, module:Class or policy:FILE.")
    ] = None,
    command: Annotated[str | None, typer.Option(help="The team's own program, in place of a brain.")] = None,
    stdio: options.StdioProgram = None,
    robot: Annotated[
        list[str] | None, typer.Option(help="Start this robot only; repeatable. By default all of the side.")
    ] = None,
    *,
    wait: Annotated[float, typer.Option(min=0.0, help="Longest wait for the host to start, in s.")] = 86_400.0,
    isolation: Annotated[dict[str, Any], FieldsOf(MatchConfig, "isolate")],
    limits: Annotated[dict[str, Any], FieldsOf(Limits)],
    passed: Annotated[dict[str, Any], FieldsOf(TeamConfig, "pass_environment")],
    agent: Annotated[dict[str, Any], FieldsOf(AgentSettings, *_SHARED)],
) -> None:
    """Run the robots of a team until the match is over: one process each, started again after a crash.

    The host runs elsewhere, with `touchline host` or `touchline match --remote`, and may start later. Logs are written
    under ./runs/. Robots are limited and isolated from this machine as in a match: docs/security.md.
    With --reload, brains that were edited play on from the next episode.

    Example: touchline team magenta --connect tcp/192.168.1.5:7447 --brain my_team:Striker
    """
    from runtime.bus.find_host import announced_credentials
    from runtime.bus.zenoh.bus import ZenohBus, open_client
    from runtime.bus.zenoh.waiting_client import open_when_there
    from touchline.launch.check_brains import check_reload
    from touchline.launch.processes.stop_signals import StopSignals
    from touchline.launch.run_folder import new_run_folder
    from touchline.launch.team_run import TeamPlan, TeamRun
    from touchline.launch.terminal.screen import screen_for

    if [brain, command, stdio].count(None) != 2:
        raise TouchlineError("a team has a brain or a program; give --brain module:Class, --command or --stdio")
    brain = brain_of(brain) if brain is not None else None
    program = options.program_of(stdio)
    settings = from_options(AgentSettings, robot=f"{side}1", brain=brain or "", stdio=program, side=side, **agent)
    own_program = options.program_of(command, "--command")
    own = from_options(TeamConfig, brain=brain, command=own_program or None, stdio=program or None, **passed)
    teams = TeamConfigs(**{side.value: own, side.opponent.value: TeamConfig(remote=True)})
    config = MatchConfig(teams=teams, limits=from_options(Limits, **limits), **isolation)
    if settings.reload:
        check_reload(config)
    clock = WallClock()

    def connect(patience: float) -> ZenohBus:
        known = settings.match, clock, settings.connect, patience, settings.credentials
        return open_client(*known, Account.of_team(side), any_match=True)

    with StopSignals() as stop:
        bus = open_when_there(connect, clock, wait, partial(typer.echo, err=True), lambda: stop.received is not None)
    if bus is None:
        return
    with bus, screen_for(sys.stdout, clock) as screen:
        credentials = settings.credentials or announced_credentials(bus.endpoint, Account.of_team(side))
        plan = TeamPlan(
            side=side,
            robots=robot or [],
            agent=settings.model_copy(update={"connect": bus.endpoint, "credentials": credentials}),
            config=config,
            folder=new_run_folder(f"{bus.match}-{side}", clock),
        )
        TeamRun(plan, bus, screen, clock).play()
