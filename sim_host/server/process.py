"""The host process: one match on an endpoint, with its signals and its log."""

import importlib.util
import logging
import signal
from collections.abc import Sequence
from contextlib import ExitStack

from runtime.access.protection import Protection, robots_of
from runtime.bus.announcement import Announcement, announced, announced_to_user
from runtime.bus.contract import ReceivedMessage
from runtime.bus.outcome_file import write_outcome
from runtime.bus.settings import check_protected
from runtime.bus.zenoh.bus import open_host
from runtime.bus.zenoh.open_access import open_access
from runtime.bus.zenoh.router_limits import router_limits
from runtime.process.clock import WallClock
from runtime.process.process_log import configure_log
from runtime.process.scheduling import use_batch_scheduling
from schemas.errors import TouchlineError, os_errors
from sim_host.missing_engine import missing_engine_text
from sim_host.server.settings import HostSettings

log = logging.getLogger("sim_host")


def run(settings: HostSettings) -> int:
    """Host one match until it is over or a signal ends this process; returns the exit status.

    Raises:
        TouchlineError: PyBullet is missing, or the endpoint cannot be listened on or is open to others unguarded.
    """
    configure_log("host", settings.log_format, text="%(asctime)s %(name)s: %(message)s")
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        _serve(settings)
    except KeyboardInterrupt:
        log.info("ended before the match was over")
    return 0


def _serve(settings: HostSettings) -> None:
    if importlib.util.find_spec("pybullet") is None:
        raise TouchlineError(missing_engine_text())
    config, listen = settings.config, settings.listen
    check_protected(settings)
    protection = Protection.from_file(settings.credentials, config)
    robots = robots_of(config)
    limits = router_limits(config.name, [name for names in robots.values() for name in names])
    if protection is None:
        limits["access_control"] = open_access(config.name, robots)
    use_batch_scheduling(config.speed is None)
    with open_host(config.name, WallClock(), listen, protection, limits) as bus, ExitStack() as announcements:
        _announce(settings, bus.endpoint, announcements)
        log.info('match "%s" on %s, pace %s, seed %d', config.name, bus.endpoint, config.pace, config.seed)
        try:
            from sim_host.server.host import Host  # takes a second, in which clients connect
        except ModuleNotFoundError as error:
            if error.name != "pybullet":
                raise
            raise TouchlineError(missing_engine_text()) from None
        host = Host(
            config,
            bus,
            settings.launch_token,
            recorders=settings.admit,
            has_accounts=protection is not None,
        )
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, lambda *_: host.stop())
        host.run()
        _leave_outcome(settings, host.outcome())
        how = "stopped before the match was over," if host.stopping else "match over"
        log.info("%s at tick %d", how, host.simulation.now.tick)


def _leave_outcome(settings: HostSettings, messages: Sequence[ReceivedMessage]) -> None:
    if settings.outcome is None:
        return
    try:
        write_outcome(settings.outcome, messages)
    except OSError as error:
        log.warning("%s: %s; the result was published on the bus only", settings.outcome, error.strerror)


def _announce(settings: HostSettings, endpoint: str, announcements: ExitStack) -> None:
    """Announce the host to its launcher, and to clients of this user."""
    announcement = Announcement.of(settings.config.name, endpoint, settings.credentials)
    with os_errors(settings.announcement, "the host announces itself there"):
        if settings.announcement is not None:
            announcements.enter_context(announced(announcement, settings.announcement))
    try:
        announcements.enter_context(announced_to_user(announcement))
    except OSError as error:
        log.warning("clients do not find this host by themselves: %s", error)
