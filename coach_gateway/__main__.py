"""`python -m coach_gateway`: serves the match's page and other bridges, or shows the match as plain lines."""

import argparse
import os
import signal
import sys
import threading
from collections.abc import Sequence
from pathlib import Path

from coach_gateway.service import Service
from coach_gateway.service import run as run_services
from coach_gateway.watching import watch
from coach_gateway.web.settings import DEFAULT_PAGES, DEFAULT_PORT, LOOPBACK, BeliefsFor, WebSettings, need_web
from schemas.bus.contract import Bus
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.bus.zenoh_bus import open_client
from schemas.clock import WallClock
from schemas.errors import TouchlineError


def run(connect: str, match: str, patience: float = 3.0) -> None:
    """Watch a match from a terminal until its host goes, or SIGINT or SIGTERM comes.

    Raises:
        TouchlineError: no host answers at that endpoint, or none that plays this match.
    """
    stop = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop.set())
    with open_client(match, WallClock(), connect, patience) as bus:
        watch(bus, say, stop)


def serve(connect: str, match: str, web: WebSettings | None) -> None:
    """Serve what is wanted until SIGINT or SIGTERM comes; hosts may come and go meanwhile.

    Raises:
        TouchlineError: a package that it needs is not installed, a port is taken, tokens cannot be read.
    """
    if web is not None:
        need_web()

    def services(bus: Bus) -> Sequence[Service]:
        made: list[Service] = []
        if web is not None:
            from coach_gateway.web.server import WebServer

            made.append(WebServer(bus, web, say))
        return made

    run_services(connect, match, services, say)


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
        )
    try:
        if web is None:
            run(options.connect, options.match)
        else:
            serve(options.connect, options.match, web)
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
    return parser


def say(line: str) -> None:
    """A line on stdout, at once."""
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
