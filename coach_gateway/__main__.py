"""`python -m coach_gateway`: shows a running match as plain lines until its host goes."""

import argparse
import os
import signal
import sys
import threading

from coach_gateway.watching import watch
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
        watch(bus, _say, stop)


def main(arguments: list[str] | None = None) -> int:
    """The process's exit status."""
    parser = argparse.ArgumentParser(prog="python -m coach_gateway", description=__doc__)
    parser.add_argument(
        "--connect", default=os.environ.get("TOUCHLINE_CONNECT", DEFAULT_ENDPOINT), help="the host's endpoint"
    )
    parser.add_argument("--match", default=os.environ.get("TOUCHLINE_MATCH", "friendly"), help="name of the match")
    options = parser.parse_args(arguments)
    try:
        run(options.connect, options.match)
    except TouchlineError as error:
        sys.stderr.write(f"touchline: {error}\n")
        return 2
    return 0


def _say(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
