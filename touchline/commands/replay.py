"""`touchline replay`: a recording back onto the bus."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from runtime.access.credentials import read_host_credentials
from runtime.access.protection import Protection
from runtime.bus.contract import Bus
from runtime.bus.endpoint import parse_endpoint
from runtime.bus.settings import ClientSettings, ListenSettings
from runtime.process.clock import Clock, WallClock
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.commands.cli import options
from touchline.commands.cli.option_groups import from_options, with_option_groups
from touchline.launch.processes.stop_signals import StopSignals
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from recordings.reading.recording import RecordedMessage
    from recordings.replay.host import ReplayHost
    from recordings.replay.live_view import LiveView
    from recordings.replay.player import Player
    from recordings.replay.replay import Replay
    from runtime.bus.zenoh.bus import ZenohBus

_REPORTED = ("time", "start", "end", "messages")
"""Fields of the last status that `--json` prints."""


@with_option_groups
def replay(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE...", help="The recording, or any *.mcap files and bag folders.")
    ],
    rate: Annotated[float, typer.Option(min=0.0, help="Recorded seconds per second; 0: as fast as possible.")] = 1.0,
    fast: Annotated[bool, typer.Option("--fast", help="Replay as fast as possible; waits for recorders.")] = False,
    start: Annotated[
        str | None,
        typer.Option("--from", "--start", help="Start: seconds, tick:812, or an event such as goal:2 or goal:2-5."),
    ] = None,
    end: Annotated[
        str | None, typer.Option("--to", help="End, inclusive: seconds, tick:812, or an event such as goal:2.")
    ] = None,
    loop: Annotated[bool, typer.Option("--loop", help="Start again at the end.")] = False,
    paused: Annotated[bool, typer.Option("--paused", help="Start paused.")] = False,
    stay: Annotated[bool, typer.Option("--stay", help="Pause at the end instead of exiting.")] = False,
    include: Annotated[
        list[str] | None,
        typer.Option("--include", "--only", help="Replay these keys only, such as robot/*/command; repeatable."),
    ] = None,
    exclude: options.Exclude = None,
    follow: Annotated[
        bool, typer.Option("--follow", help="The file is still being written: continue with appended messages.")
    ] = False,
    behind: Annotated[
        float, typer.Option(min=0.0, help="With --follow: start this far behind the end of the file, simulated s.")
    ] = 5.0,
    connect: Annotated[
        str | None, typer.Option(help="Endpoint of a running host to replay beside, instead of --listen.")
    ] = None,
    match: Annotated[
        str | None, typer.Option("--match", "--name", help="Name of the match on the bus; by default the recorded one.")
    ] = None,
    prefix: Annotated[
        str, typer.Option(help="Prefix of the match name, such as replay_; of any other file, of its keys.")
    ] = "",
    rename: Annotated[
        list[str] | None,
        typer.Option(metavar="OLD=NEW", help="Rename a key, or the beginning of keys: robot1=robot2; repeatable."),
    ] = None,
    agent: Annotated[
        list[str] | None,
        typer.Option(
            help="Give a robot's sights to a brain here, and compare its commands: cyan2=module:Class; no bus."
        ),
    ] = None,
    brain_folder: Annotated[
        Path | None, typer.Option(help="With --agent: look for the brain's module here first; by default only in ./.")
    ] = None,
    every_difference: Annotated[
        bool, typer.Option("--every-difference", help="With --agent: go on after the first difference.")
    ] = False,
    pdb: Annotated[
        bool,
        typer.Option("--pdb", help="With --agent: stop in Python's debugger before --from, or the first difference."),
    ] = False,
    live: Annotated[
        bool, typer.Option("--live", help="With --agent: simulate on from --from with this brain; no bus.")
    ] = False,
    out: Annotated[Path | None, typer.Option(help="With --live: the recording to write of the match.")] = None,
    web: options.Web = False,
    foxglove: Annotated[
        bool, typer.Option("--foxglove", help="Serve a live view for Foxglove and Lichtblick and print its address.")
    ] = False,
    foxglove_port: Annotated[int, typer.Option(help="Port of the live view; 0 selects a free port.")] = 8765,
    json: options.Json = False,
    *,
    listening: ListenSettings,
    page: options.PageOptions,
) -> None:
    """Replay a recording on the bus, with the keys, order and timing of the match.

    MCAP files of any other writer, several at once, are replayed on keys named like their topics: docs/any_mcap.md.

    The page of --web, and viewers of --foxglove, pause it, seek and change its rate; with either it stays at its end.

    With --agent, the sights of a robot are given to a brain in this process, where print and breakpoint() work. A table
    shows each command that differs from the recorded one, up to the first: docs/debugging.md.

    Example: touchline replay runs/friendly-20260101T120000Z-seed1/match.mcap --from goal:1-5 --rate 2

    Example: touchline replay robot1.mcap robot2.mcap --rate 10 --only "camera/**" --prefix test

    Example: touchline replay match.mcap --agent cyan2=my_team:Striker --from tick:812 --pdb
    """
    if agent:
        from touchline.team.debugger.agent_replay import AgentReplay, parse_agent

        on_the_bus: dict[str, object] = {"--fast": fast, "--loop": loop, "--paused": paused, "--stay": stay}
        on_the_bus |= {"--include": include, "--exclude": exclude, "--follow": follow, "--connect": connect}
        on_the_bus |= {"--match": match, "--prefix": prefix, "--web": web, "--foxglove": foxglove}
        on_the_bus |= {"--rate": rate != 1.0, "--rename": rename, "a second FILE": files[1:]}
        robot, brain = parse_agent(agent[0], on_the_bus | {"a second --agent": agent[1:]})
        debugged = AgentReplay(
            files[0], robot, brain, start, end, every_difference, pdb, brain_folder, live=live, out=out, json=json
        )
        raise typer.Exit(debugged.run())
    if every_difference or pdb or live or out or brain_folder:
        raise TouchlineError(
            "--every-difference, --pdb, --live, --out and --brain-folder need --agent, such as --agent cyan2=my:Brain"
        )
    from coach_gateway.web.settings import WebSettings
    from recordings.reading.log_order import is_match
    from recordings.replay.replay import Replay, ReplaySettings
    from touchline.launch.page import open_page, serve_page_beside
    from touchline.launch.replay_run import run_replay

    options.check_numbers(rate=rate, behind=behind)
    if fast and rate != 1.0:
        raise TouchlineError(f"--fast and --rate {rate:g} are two speeds; give one of them")
    settings = ReplaySettings(
        files[0],
        start=start,
        end=end,
        rate=None if fast else rate or None,
        loop=loop,
        paused=paused,
        stay=stay or web or foxglove,
        selection=options.selection(include, exclude),
        follow=follow,
        behind=behind,
    )
    if connect is not None and listening.credentials is not None:
        raise TouchlineError(
            f"--connect {connect}: no account of a host with credentials may publish a replay; leave --connect out"
        )
    if connect is not None and listening.listen is not None:
        raise TouchlineError(f"--listen is in place of --connect {connect}; leave one of them out")
    listen = options.endpoint_of(listening) if connect is None else None
    opened_page = open_page(from_options(WebSettings, **page)) if web else None
    if not is_match(files):
        if follow:
            raise TouchlineError(f"--follow: {files[0]} is no recording of a match; leave --follow out")
        from recordings.replay.log_replay import Keys
        from touchline.launch.log_replay import replay_log

        ended = replay_log(
            files,
            settings,
            Keys(settings, rename or [], prefix),
            name=from_options(ClientSettings, match=match).match or "replay",
            connect=connect,
            listen=listen,
            credentials=listening.credentials,
            page=opened_page,
            viewers=foxglove_port if foxglove else None,
            quiet=json,
        )
        if json:
            typer.echo(json_text({name: getattr(ended, name) for name in _REPORTED}))
        return
    if rename:
        raise TouchlineError(f"--rename: the keys of a match, {files[0]}, have their names; leave it out")
    opened = Replay(settings)
    clock = WallClock()
    name = prefix + (match or opened.recording.manifest.match)
    from_options(ClientSettings, match=name)
    with ExitStack() as stack:
        protection = _protection(opened, name, listening.credentials)
        bus = stack.enter_context(_open_bus(name, clock, connect, listen, protection, listening.credentials))
        stop = stack.enter_context(StopSignals())  # before any address is printed
        look_after = stack.enter_context(serve_page_beside(bus, opened_page, listening.credentials))
        view = stack.enter_context(closing(_live_view(opened, foxglove_port))) if foxglove else None
        began = clock.now()
        status = run_replay(_host(opened, bus, view), stop, look_after, view, quiet=json)
        wall = clock.now() - began
    if json:
        fields = {name: getattr(status, name) for name in _REPORTED}
        typer.echo(json_text(fields | {"wall_s": round(wall, 3)}))


def _protection(opened: "Replay", match: str, credentials: Path | None) -> Protection | None:
    """The protection of the replay's own host; None without credentials."""
    if credentials is None:
        return None

    setup = opened.recording.manifest.setup
    robots = {side: setup.teams[side].robots if setup is not None else [] for side in Side}
    return Protection.of(read_host_credentials(credentials), match, robots)


@contextmanager
def _open_bus(
    match: str,
    clock: Clock,
    connect: str | None,
    listen: str | None,
    protection: Protection | None,
    credentials: Path | None,
) -> "Iterator[ZenohBus]":
    """A client's bus beside the running host at `connect`; without one, the bus of a host, which clients find."""
    from runtime.bus.announcement import Announcement, announced_to_user
    from runtime.bus.zenoh.bus import open_client, open_host

    with ExitStack() as stack:
        if connect is not None:
            parse_endpoint(connect)
            bus = stack.enter_context(open_client(match, clock, connect))
        else:
            bus = stack.enter_context(open_host(match, clock, listen, protection))
            try:
                stack.enter_context(announced_to_user(Announcement.of(match, bus.endpoint, credentials)))
            except OSError as error:
                typer.echo(f"touchline: clients do not find this replay by themselves: {error}", err=True)
        typer.echo(f'match "{match}" {"on" if connect is None else "at"} {bus.endpoint}', err=True)
        yield bus


def _live_view(opened: "Replay", port: int) -> "LiveView":
    """A view of the whole recording; the extent of a growing recording is unknown."""
    from recordings.replay.live_view import LiveView

    manifest = opened.recording.manifest
    extent = None if opened.settings.follow else (opened.cursor.start_ns, opened.cursor.end_ns)
    view = LiveView(f"Touchline: {manifest.match}", manifest.setup, extent, port)
    typer.echo(f"Foxglove, Lichtblick: open the connection {view.address}", err=True)
    return view


def _host(opened: "Replay", bus: Bus, view: "LiveView | None") -> "ReplayHost":
    """The host of the replay, which shows all that it publishes to viewers, too."""
    from recordings.replay.host import ReplayHost

    def make_player(publish: "Callable[[RecordedMessage], None]", can_publish: Callable[[], bool]) -> "Player":
        def publish_and_show(recorded: "RecordedMessage") -> None:
            publish(recorded)
            if view is not None:
                view.publish(recorded)

        return opened.player(bus.clock, publish=publish_and_show, can_publish=can_publish)

    return ReplayHost(bus, opened.recording.manifest.setup, make_player)
