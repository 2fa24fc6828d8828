"""Replays MCAP files that are no recordings of a match, on a network of Zenoh."""

from collections.abc import Sequence
from contextlib import ExitStack, closing
from pathlib import Path

import typer

from recordings.reading.log_order import check_no_match, open_log
from recordings.replay.live_view import LiveView
from recordings.replay.log_replay import Keys, LogReplay
from recordings.replay.replay import ReplaySettings
from runtime.access.credentials import read_host_credentials
from runtime.access.protection import Protection
from runtime.bus.contract import PresenceKind
from runtime.bus.zenoh.any_keys import open_network
from runtime.process.clock import WallClock
from schemas.errors import TouchlineError
from schemas.messages.replay import ReplayReply
from touchline.launch.page import serve_page_beside
from touchline.launch.processes.programs import Page
from touchline.launch.processes.stop_signals import StopSignals
from touchline.launch.replay_run import run_replay


def replay_log(
    files: Sequence[Path],
    settings: ReplaySettings,
    keys: Keys,
    *,
    name: str,
    connect: str | None,
    listen: str | None,
    credentials: Path | None,
    page: Page | None,
    viewers: int | None,
    quiet: bool,
) -> ReplayReply:
    """Replay until the end or a signal; the controls are those of a match named `name`, on a page, too.

    There is a live view on the port `viewers`, unless it is None. Without `connect` it is a router; with `credentials`,
    the file of a host, only those who have an account are admitted.

    Raises:
        TouchlineError: a file cannot be read, a topic cannot be a key, or there is no network.
        Exit: a signal ended it.
    """
    log = open_log(files, keys.of)
    check_no_match(log)
    if keys.unused:
        raise TouchlineError(f"--rename: no topic has the key {min(keys.unused)}; `touchline info` lists them")
    with ExitStack() as stack:
        known = Protection.of_any_keys(read_host_credentials(credentials), name) if credentials is not None else None
        bus = stack.enter_context(open_network(name, WallClock(), connect, listen, protection=known))
        stop = stack.enter_context(StopSignals())
        typer.echo(f"{len(log.channels)} channels {'to' if connect else 'at'} {bus.endpoint}", err=True)
        view = None
        if viewers is not None:
            extent = log.base_ns, log.base_ns + log.end_ns
            view = stack.enter_context(closing(LiveView(f"Touchline: {name}", None, extent, viewers, log.base_ns)))
            typer.echo(f"Foxglove, Lichtblick: open the connection {view.address}", err=True)
        replay = LogReplay(bus, log, settings, *([view.publish_of_log] if view is not None else []))
        if page is not None:
            bus.declare_alive(PresenceKind.HOST, "host")  # for which a page looks
        look_after = stack.enter_context(serve_page_beside(bus, page, credentials))
        return run_replay(replay, stop, look_after, view, quiet=quiet)
