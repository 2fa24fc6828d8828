"""`python -m sim_host`: one host process."""

import argparse
import logging
import signal
import sys
from pathlib import Path

from schemas.bus.endpoint import DEFAULT_ENDPOINT, is_loopback, with_free_port
from schemas.bus.zenoh.bus import open_host
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.process.clock import WallClock
from schemas.process.scheduling import use_batch_scheduling

log = logging.getLogger("sim_host")


def serve(config: MatchConfig, listen: str, *, insecure: bool = False) -> None:
    """Host one match on an endpoint until it is over or somebody ends this process.

    Raises:
        TouchlineError: PyBullet is missing, the endpoint cannot be listened on, or is open to others unguarded.
    """
    try:
        from sim_host.server.host import Host
    except ModuleNotFoundError as error:
        if error.name != "pybullet":
            raise
        raise TouchlineError(
            "PyBullet is not installed; on this machine that takes: pip install 'touchline[sim]'"
        ) from None
    if not insecure and not is_loopback(listen):
        raise TouchlineError(f"--listen {listen} can be reached by others; say --insecure if that is what you want")
    use_batch_scheduling(config.speed is None)
    with open_host(config.name, WallClock(), with_free_port(listen)) as bus:
        log.info("match %s on %s, pace %s, seed %d", config.name, listen, config.pace, config.seed)
        host = Host(config, bus)
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, lambda *_: host.stop())
        host.run()
        how = "stopped before the match was over," if host.stopping else "match over"
        log.info("%s at tick %d", how, host.simulation.now.tick)


def main(arguments: list[str] | None = None) -> int:
    """Run the host; 0 when the match was played, 2 on wrong input."""
    parser = argparse.ArgumentParser(prog="python -m sim_host", description=__doc__)
    parser.add_argument("--config", type=Path, help="a MatchConfig as JSON; without it the default match")
    parser.add_argument("--listen", default=DEFAULT_ENDPOINT)
    parser.add_argument("--insecure", action="store_true", help="listen beyond this machine without credentials")
    options = parser.parse_args(arguments)
    logging.basicConfig(level=logging.INFO, stream=sys.stderr, format="%(asctime)s %(name)s: %(message)s")
    signal.signal(signal.SIGTERM, _interrupt)
    try:
        config = MatchConfig.model_validate_json(options.config.read_bytes()) if options.config else MatchConfig()
        serve(config, options.listen, insecure=options.insecure)
    except TouchlineError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    except KeyboardInterrupt:
        log.info("ended before the match was over")
    return 0


def _interrupt(signum: int, frame: object) -> None:
    del signum, frame
    raise KeyboardInterrupt


if __name__ == "__main__":
    sys.exit(main())
