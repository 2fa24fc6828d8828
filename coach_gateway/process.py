"""The gateway process: the match's page and other bridges, or the match as plain lines."""

import signal
import socket
import sys
import threading
from collections.abc import Callable

from coach_gateway.access.tokens import Tokens, tokens_of
from coach_gateway.bridges import bridges_of, services_of
from coach_gateway.match.change_log import log_changes
from coach_gateway.match.team_names import printable
from coach_gateway.ports import InheritedSockets
from coach_gateway.service import Service
from coach_gateway.service import run as run_services
from coach_gateway.settings import GatewaySettings
from coach_gateway.web.settings import WebSettings, need_web
from schemas.access.accounts import Account
from schemas.bus.contract import Bus
from schemas.bus.zenoh.bus import open_client
from schemas.process.clock import WallClock
from schemas.process.process_log import configure_log, log_line

_PATIENCE = 3.0
"""s of wall time to find a host whose match is to be shown; services wait for theirs however long it takes."""


def run(settings: GatewaySettings) -> int:
    """Serve, or show the match, until SIGINT or SIGTERM comes; the exit status of the process.

    Raises:
        TouchlineError: no host answers, a package is not installed, a port is taken, or tokens cannot be read.
    """
    configure_log("gateway", settings.log_format)
    if settings.web is None and not settings.bridges.wanted:
        _show(settings)
    else:
        _serve(settings)
    return 0


def _show(settings: GatewaySettings) -> None:
    """Print the match until its host goes."""
    stop = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop.set())
    with open_client(
        settings.match, WallClock(), settings.connect, _PATIENCE, settings.credentials, Account.VIEWER
    ) as bus:
        log_changes(bus, say, stop)


def _serve(settings: GatewaySettings) -> None:
    """Serve what is wanted; hosts may come and go meanwhile."""
    bridges, inherited = bridges_of(settings.bridges), InheritedSockets()
    ports = bridges.open_ports(inherited)
    known = tokens_of(settings.tokens)
    page, waiting_page = (
        _page(settings, settings.web, known, inherited.next()) if settings.web is not None else (None, None)
    )
    if page is None and bridges.udp is not None:
        for line in [f"tokens: {settings.tokens}"] if settings.tokens is not None else known.lines():
            say(line)

    def services(bus: Bus) -> list[Service]:
        return [*([page(bus)] if page is not None else []), *services_of(bus, bridges, ports, known, say)]

    run_services(settings, services, say, waiting_page)


def _page(
    settings: GatewaySettings, web: WebSettings, tokens: Tokens, listener: socket.socket | None
) -> tuple[Callable[[Bus], Service], Service]:
    """What serves the page once there is a match, and what does before; prints at once where the page is."""
    need_web()
    from coach_gateway.web.binding import bind_page
    from coach_gateway.web.server import WebServer
    from coach_gateway.web.waiting_page import WaitingPage

    binding = bind_page(web, tokens, settings.tokens, listener)
    for line in binding.lines():
        say(line)
    return (lambda bus: WebServer(bus, binding, say, settings.result)), WaitingPage(binding, settings.match, log=say)


def say(line: str) -> None:
    """A line on stdout, at once."""
    log_line(printable(line), stream=sys.stdout)
