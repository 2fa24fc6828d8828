"""The host process: one match on an endpoint, with its signals and its log."""

import logging
import signal
import sys
from types import FrameType

from schemas.bus.endpoint import is_loopback, with_free_port
from schemas.bus.zenoh.bus import open_host
from schemas.errors import TouchlineError
from schemas.process.clock import WallClock
from schemas.process.scheduling import use_batch_scheduling
from sim_host.server.settings import HostSettings

log = logging.getLogger("sim_host")


def run(settings: HostSettings) -> int:
    """Host one match until it is over or a signal ends this process; returns the exit status.

    Raises:
        TouchlineError: PyBullet is missing, or the endpoint cannot be listened on or is open to others unguarded.
    """
    logging.basicConfig(level=logging.INFO, stream=sys.stderr, format="%(asctime)s %(name)s: %(message)s")
    signal.signal(signal.SIGTERM, _leave)
    try:
        _serve(settings)
    except KeyboardInterrupt:
        log.info("ended before the match was over")
    return 0


def _serve(settings: HostSettings) -> None:
    try:
        from sim_host.server.host import Host
    except ModuleNotFoundError as error:
        if error.name != "pybullet":
            raise
        raise TouchlineError(
            "PyBullet is not installed; on this machine that takes: pip install 'touchline[sim]'"
        ) from None
    config, listen = settings.config, settings.listen
    if not settings.insecure and not is_loopback(listen):
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


def _leave(signum: int, frame: FrameType | None) -> None:
    del signum, frame
    raise KeyboardInterrupt
