"""One robot's process: options, bus, brain, run.

    python -m robot_agent --connect tcp/127.0.0.1:7447 --match friendly --robot cyan1 --brain my_team:Brain

Each option may come from the environment instead, as TOUCHLINE_CONNECT and so on. Exit status: 0 the match is over
or the process was ended, 1 the brain raised, 2 wrong usage or no host.
"""

import argparse
import os
import signal
import sys
from types import FrameType

from robot_agent.contract import Brain, Briefing, load_brain
from robot_agent.runner import serve
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.bus.zenoh.bus import open_client
from schemas.config.match_config import LOCKSTEP
from schemas.errors import TouchlineError
from schemas.messages.host import Setup
from schemas.process.clock import WallClock
from schemas.process.scheduling import use_batch_scheduling


def main(arguments: list[str] | None = None) -> int:
    """Run one robot; the exit status of the process."""
    options = _options(arguments)
    signal.signal(signal.SIGTERM, _end)
    try:
        with open_client(options.match, WallClock(), options.connect, options.patience) as bus:

            def build(setup: Setup) -> Brain:
                use_batch_scheduling(setup.pace == LOCKSTEP)
                return load_brain(options.brain, Briefing.of(options.robot, setup))

            return serve(bus, build, options.robot, options.patience)
    except TouchlineError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    except KeyboardInterrupt:
        return 0


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m robot_agent", description="Run one robot's brain in a match.")
    options = (
        ("connect", "endpoint of the host", DEFAULT_ENDPOINT),
        ("match", "name of the match", None),
        ("robot", "name of the robot", None),
        ("brain", '"module:Class", or "module:function" of a plain act(sight)', None),
    )
    for name, says, default in options:
        variable = f"TOUCHLINE_{name.upper()}"
        given = os.environ.get(variable, default)
        parser.add_argument(
            f"--{name}", default=given, required=given is None, help=f"{says} (or {variable}; default: {given})"
        )
    parser.add_argument(
        "--patience", type=float, default=10.0, help="s of wall time to wait for a host that is not there (10)"
    )
    return parser.parse_args(arguments)


def _end(number: int, frame: FrameType | None) -> None:
    """A polite end, from a supervisor as from a keyboard."""
    del number, frame
    raise KeyboardInterrupt


if __name__ == "__main__":
    sys.exit(main())
