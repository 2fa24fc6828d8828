"""`python -m coach_gateway`: serves the match's page and other bridges, or shows the match as plain lines."""

import argparse
import os
import signal
import sys
import threading
from collections.abc import Callable
from pathlib import Path

from coach_gateway import refbox
from coach_gateway.access.tokens import Tokens, tokens_of
from coach_gateway.bridges import NO_BRIDGES, Bridges, bridges_of, services_of
from coach_gateway.match.change_log import log_changes
from coach_gateway.match.lines import printable
from coach_gateway.ports import LOOPBACK
from coach_gateway.refbox.framing import BoxProtocol
from coach_gateway.service import Service
from coach_gateway.service import run as run_services
from coach_gateway.web.settings import (
    DEFAULT_PAGES,
    DEFAULT_PAGES_EACH,
    DEFAULT_PORT,
    BeliefsFor,
    WebSettings,
    need_web,
)
from schemas.bus.contract import Bus
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.bus.zenoh.bus import open_client
from schemas.errors import TouchlineError
from schemas.process.clock import WallClock
from schemas.side import Side


def run(connect: str, match: str, patience: float = 3.0) -> None:
    """Watch a match from a terminal until its host goes, or SIGINT or SIGTERM comes.

    Raises:
        TouchlineError: no host answers at that endpoint, or none that plays this match.
    """
    stop = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop.set())
    with open_client(match, WallClock(), connect, patience) as bus:
        log_changes(bus, log, stop)


def serve(
    connect: str, match: str, web: WebSettings | None, bridges: Bridges = NO_BRIDGES, tokens: Path | None = None
) -> None:
    """Serve what is wanted until SIGINT or SIGTERM comes; hosts may come and go meanwhile.

    `tokens` is the file of the tokens where no page is served; without one they last as long as the process.

    Raises:
        TouchlineError: a package that it needs is not installed, a port is taken, tokens cannot be read.
    """
    bridges.try_ports()
    known = tokens_of(web.tokens if web is not None else tokens)
    page, waiting_page = _page(web, known, match) if web is not None else (None, None)
    if page is None and bridges.udp is not None:
        for line in [f"tokens: {tokens}"] if tokens is not None else known.lines():
            log(line)

    def services(bus: Bus) -> list[Service]:
        return [*([page(bus)] if page is not None else []), *services_of(bus, bridges, known, log)]

    run_services(connect, match, services, log, waiting_page)


def _page(settings: WebSettings, tokens: Tokens, match: str) -> tuple[Callable[[Bus], Service], Service]:
    """What serves the page once there is a match, and what does before; where it is, is said at once."""
    need_web()
    from coach_gateway.web.binding import bind_page
    from coach_gateway.web.server import WebServer
    from coach_gateway.web.waiting_page import WaitingPage

    binding = bind_page(settings, tokens)
    for line in binding.lines():
        log(line)
    return (lambda bus: WebServer(bus, binding, log)), WaitingPage(binding, match)


def main(arguments: list[str] | None = None) -> int:
    """The process's exit status."""
    options = _parser().parse_args(arguments)
    web = None
    if options.web:
        web = WebSettings(
            port=options.port,
            listen=options.listen_web,
            tokens=options.tokens,
            origins=tuple(options.allow_origin),
            beliefs=options.beliefs,
            pages=options.pages,
            pages_each=options.pages_per_address,
        )
    try:
        bridges = bridges_of(
            udp=options.udp,
            refbox_at=options.refbox,
            teams=options.team,
            protocol=options.refbox_protocol,
            server_addresses=options.refbox_server,
            audience=options.audience,
            listen=options.listen_bridges,
        )
        if web is None and not bridges.wanted:
            run(options.connect, options.match)
        else:
            serve(options.connect, options.match, web, bridges, options.tokens)
    except TouchlineError as error:
        sys.stderr.write(f"touchline: {error}\n")
        return 2
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m coach_gateway", description=__doc__)
    environment = os.environ
    parser.add_argument(
        "--connect", default=environment.get("TOUCHLINE_CONNECT", DEFAULT_ENDPOINT), help="the host's endpoint"
    )
    parser.add_argument("--match", default=environment.get("TOUCHLINE_MATCH", "friendly"), help="name of the match")
    page = parser.add_argument_group("the page")
    page.add_argument("--web", action="store_true", help="serve it")
    page.add_argument("--port", type=int, default=DEFAULT_PORT, help="port of the page; 0 takes a free one")
    page.add_argument("--listen-web", default=LOOPBACK, help="address to serve it on")
    page.add_argument(
        "--tokens",
        type=Path,
        default=environment.get("TOUCHLINE_TOKENS"),
        help="file of the tokens, made when it is not there; without one they last as long as the process",
    )
    page.add_argument("--allow-origin", action="append", default=[], help="a further origin the page may come from")
    page.add_argument(
        "--beliefs",
        type=BeliefsFor,
        choices=list(BeliefsFor),
        help="who is shown what robots believe: all, or teams",
    )
    page.add_argument("--pages", type=int, default=DEFAULT_PAGES, help="how many may be open at once")
    page.add_argument(
        "--pages-per-address", type=int, default=DEFAULT_PAGES_EACH, help="how many of them from one other address"
    )
    _add_bridges(parser.add_argument_group("bridges"))
    return parser


def _add_bridges(bridges: argparse._ArgumentGroup) -> None:
    bridges.add_argument("--udp", type=int, metavar="PORT", help="hear coach programs over UDP; 0 takes a free port")
    bridges.add_argument("--refbox", metavar="HOST[:PORT]", help="be a base station at a league's referee box")
    bridges.add_argument(
        "--team", type=Side, choices=list(Side), action="append", default=[], help="whose base station; may be repeated"
    )
    bridges.add_argument(
        "--refbox-protocol",
        type=BoxProtocol,
        choices=list(BoxProtocol),
        default=BoxProtocol.AUTO,
        help="how that box speaks",
    )
    bridges.add_argument(
        "--refbox-server",
        nargs="?",
        const=str(refbox.DEFAULT_PORT),
        action="append",
        default=[],
        metavar="[SIDE:]PORT",
        help=f"be a referee box for team software, by default on port {refbox.DEFAULT_PORT}; may be repeated",
    )
    bridges.add_argument(
        "--audience", action="append", default=[], metavar="HOST:PORT", help="send the audience feed there; likewise"
    )
    bridges.add_argument("--listen-bridges", default=LOOPBACK, help="address that programs and base stations come to")


def log(line: str) -> None:
    """A line on stdout, at once."""
    sys.stdout.write(printable(line) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
