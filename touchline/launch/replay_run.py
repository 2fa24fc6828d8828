"""A replay in a terminal: its progress, its viewers and its page, until it ends or is interrupted."""

import sys
from collections.abc import Callable

import typer

from recordings.replay.host import ReplayLoop
from recordings.replay.live_view import LiveView
from recordings.replay.player import Player
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest
from touchline.launch.processes.stop_signals import StopSignals
from touchline.launch.processes.supervisor import Notice
from touchline.launch.terminal.replay_progress import bar_text, status_text
from touchline.launch.terminal.screen import screen_for


def run_replay(
    replay: ReplayLoop, stop: StopSignals, look_after: Callable[[], list[Notice]], view: LiveView | None, *, quiet: bool
) -> ReplayReply:
    """Play until the end or a signal; the last status. `quiet` leaves standard output to what follows.

    Raises:
        Exit: a signal ended it.
        TouchlineError: the recording is damaged inside.
    """
    stream = sys.stderr if quiet else sys.stdout
    text_of = bar_text if stream.isatty() else status_text
    with screen_for(stream, replay.clock) as screen:

        def meanwhile(player: Player) -> None:
            if stop.received is not None:
                player.control(ReplayRequest(operation=ReplayOperation.LEAVE))
            screen.status(text_of(player.status()))
            if view is not None:
                view.update(player)
            for notice in look_after():
                typer.echo(f"touchline: {notice.sentence}", err=True)

        replay.run(meanwhile)
        screen.event(text_of(replay.player.status()), notable=True)
    if replay.unknown_keys:
        typer.echo(f"touchline: {replay.unknown_keys} messages on unknown keys were left out", err=True)
    if stop.received is not None:
        raise typer.Exit(128 + stop.received)
    return replay.player.status()
