"""The gateway process: the match's page and other bridges."""

import socket
import sys
from contextlib import ExitStack
from typing import TYPE_CHECKING

from coach_gateway.access.tokens import Tokens, tokens_of
from coach_gateway.bridges import bridges_of, open_without_host, services_of
from coach_gateway.match.team_names import printable
from coach_gateway.ports import InheritedSockets
from coach_gateway.service import Service
from coach_gateway.service import run as run_services
from coach_gateway.settings import GatewaySettings
from coach_gateway.web.settings import WebSettings, need_web
from runtime.bus.contract import Bus
from runtime.process.process_log import configure_log, log_line
from schemas.errors import TouchlineError

if TYPE_CHECKING:
    from coach_gateway.web.serving.server import WebServer


def run(settings: GatewaySettings) -> int:
    """Serve what is wanted until SIGINT or SIGTERM comes; hosts may come and go meanwhile. Returns the exit status.

    Raises:
        TouchlineError: nothing is wanted, a package is not installed, a port is taken, or tokens cannot be read.
    """
    configure_log("gateway", settings.log_format)
    settings.alone.check(has_credentials=settings.credentials is not None)
    if settings.web is None and not settings.bridges.wanted and settings.alone.match_file is None:
        raise TouchlineError("the settings have neither a page nor a bridge; add `web` or `bridges`")
    bridges, inherited = bridges_of(settings.bridges), InheritedSockets()
    ports = bridges.open_ports(inherited)
    known = tokens_of(settings.tokens)
    page = _page(settings, settings.web, known, inherited.next()) if settings.web is not None else None
    if page is None and bridges.udp is not None:
        for line in [f"tokens: {settings.tokens}"] if settings.tokens is not None else known.lines():
            say(line)

    def services(bus: Bus) -> list[Service]:
        shown: list[Service] = [page.show(bus)] if page is not None else []
        return shown + (services_of(bus, bridges, ports, known, say) if settings.bridges.wanted else [])

    others: list[Service] = [page] if page is not None else []
    with ExitStack() as stack:
        if settings.alone.match_file is not None:
            bus, game = open_without_host(settings)
            stack.enter_context(bus)
            say(f"match {bus.match} without a host, at {bus.endpoint}")
            settings = settings.model_copy(update={"connect": bus.endpoint, "match": bus.match})
            others.append(game)
        run_services(settings, services, say, others)
    return 0


def _page(settings: GatewaySettings, web: WebSettings, tokens: Tokens, listener: socket.socket | None) -> "WebServer":
    """The server of the page; prints where the page is before there is a match."""
    need_web()
    from coach_gateway.web.serving.binding import bind_page
    from coach_gateway.web.serving.server import WebServer

    binding = bind_page(web, tokens, settings.tokens, listener)
    for line in binding.lines():
        say(line)
    return WebServer(binding, settings.match, say, settings.result)


def say(line: str) -> None:
    """A line on stdout, at once."""
    log_line(printable(line), stream=sys.stdout)
