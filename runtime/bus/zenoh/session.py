"""The Zenoh session of a host or a client: settings, threads and endpoint.

Multicast scouting, gossip and shared memory are off; a process listens on the given address only.
"""

import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import zenoh

from runtime.access.credentials import Credentials
from runtime.access.protection import Protection
from runtime.bus.contract import Bus, BusError, EndpointInUseError
from runtime.bus.endpoint import DEFAULT_ENDPOINT, FREE_ENDPOINT, with_free_port, with_tls
from runtime.bus.zenoh.protection_settings import client_settings, router_settings
from runtime.bus.zenoh.unreachable import why_unreachable
from runtime.bus.zenoh.wait_timer import WaitTimer
from runtime.process.clock import Clock
from runtime.process.timing import CONGESTION_US, FIRST_ATTEMPT_S, HANDSHAKE_S, LEASE_S, RETRY_FROM_MS, RETRY_TO_MS

_THREADS = "ZENOH_RUNTIME"
"""Environment variable with Zenoh's thread settings."""
_MOST_AHEAD, _MOST_AHEAD_MS = "UHLC_MAX_DELTA_MS", "1"
"""Environment variable with the time by which a time stamp may be ahead of the router's clock, in ms. The router takes
over the time of a later stamp, and stamps the messages of all others with it; one further ahead is replaced."""
_CLIENT_THREADS = "(app: (worker_threads: 4), rx: (handover: app), acc: (handover: app), tx: (worker_threads: 1))"
"""Few threads, since a match has many small processes. Closing a link whose data was not sent, as after a cut of the
network, blocks a thread for up to 10 s: Zenoh's sockets have `SO_LINGER` (eclipse-zenoh/zenoh, issue 2350).

The thread that sends closes no link. With its own, a message wakes it alone: one of several threads that share their
tasks wakes another one as soon as it has found a task, and that one finds nothing."""
_HOST_THREADS = "(app: (worker_threads: 16), rx: (handover: app), acc: (handover: app), tx: (worker_threads: 1))"
"""A thread that waits for room in a link's queue, as a reply from a cache does, must not be the thread that makes the
room. Zenoh closes a stalled link on the threads that read: if there were few, all of them could be waiting for room in
that link, and the host would block for good (eclipse-zenoh/zenoh, issue 1876).

The runtime `net` keeps its single thread: with several, two links that closed at the same time could end one of them by
a panic in the routing tables (zenoh 1.10)."""
_RETRY = {"period_init_ms": RETRY_FROM_MS, "period_max_ms": RETRY_TO_MS, "period_increase_factor": 1.5}


@dataclass(frozen=True, slots=True)
class SessionContext:
    """The session with the state that publishers and subscriptions of one match share."""

    session: zenoh.Session
    prefix: str
    """The prefix of every key."""
    clock: Clock
    is_client: bool
    timer: WaitTimer
    """Ends waits at their deadline."""
    owner: Bus
    """The bus, which must be closed before the interpreter ends, and exists as long as the session is in use."""


def open_router(
    listen: str | None, protection: Protection | None = None, limits: Mapping[str, object] | None = None
) -> tuple[zenoh.Session, str]:
    """The host's session, a router that listens on one endpoint, and that endpoint.

    Port 0 takes a free port. None takes the default endpoint, or a free port where another process listens there.

    Args:
        protection: users, what each may do, and the certificate; None admits everybody to everything.
        limits: further settings of the router.

    Raises:
        EndpointInUseError: another process listens on the endpoint.
        BusError: it cannot listen on the endpoint.
    """
    has_tls = protection is not None and protection.credentials.certificate is not None
    with router_settings(protection) as settings:
        more = {**settings, **(limits or {})}
        if listen is not None:
            return _listen_on(listen, has_tls, more)
        try:
            return _listen_on(DEFAULT_ENDPOINT, has_tls, more)
        except EndpointInUseError:
            return _listen_on(FREE_ENDPOINT, has_tls, more)


def _listen_on(listen: str, has_tls: bool, more: Mapping[str, object]) -> tuple[zenoh.Session, str]:
    try:
        endpoint = with_free_port(with_tls(listen) if has_tls else listen)
    except OSError as error:
        raise BusError(f"--listen {listen} cannot be listened on ({error.strerror}); choose another address") from None
    config = _config(
        "router",
        {
            "listen/endpoints": [endpoint],
            "transport/link/tx/queue/congestion_control/block/wait_before_close": CONGESTION_US,
            **more,
        },
    )
    try:
        return _open(config, _HOST_THREADS), endpoint
    except zenoh.ZError as error:
        remedy = f"choose another port, or {FREE_ENDPOINT} for a free one"
        if "ddress already in use" in str(error):
            raise EndpointInUseError(f"--listen {listen} is in use by another process; {remedy}") from None
        raise BusError(f"--listen {listen} cannot be listened on ({first_line(error)}); {remedy}") from None


def open_connection(
    find: Callable[[], tuple[str, Credentials | None]],
    clock: Clock,
    patience: float,
    more: Mapping[str, object] = MappingProxyType({}),
) -> tuple[zenoh.Session, str, Credentials | None]:
    """A client's session, with attempts for `patience` s of wall time, its host's endpoint and its credentials.

    `find` returns endpoint and credentials before each attempt: a host may start, and announce them, meanwhile. `more`
    are further settings of the session.

    Raises:
        BusError: no host admits this client.
    """
    deadline = clock.now() + patience
    lasts = FIRST_ATTEMPT_S
    while True:
        connect, credentials = find()
        if credentials is not None and credentials.root_certificate is not None:
            connect = with_tls(connect)
        settings = {
            "connect/endpoints": [connect],
            "connect/retry": _RETRY,
            "connect/timeout_ms": round(lasts * 1000),
            "transport/unicast/open_timeout": round(1000 * max(lasts, HANDSHAKE_S)),
            **client_settings(credentials),
            **more,
        }
        try:
            return _open(_config("client", settings), _CLIENT_THREADS), connect, credentials
        except zenoh.ZError as error:
            if clock.now() >= deadline:
                raise BusError(why_unreachable(connect, credentials)) from error
            clock.sleep_until(clock.now() + RETRY_TO_MS / 1000)
            lasts = min(2 * lasts, LEASE_S)


def _open(config: zenoh.Config, threads: str) -> zenoh.Session:
    """Open a session with these threads, unless the environment sets others.

    Zenoh reads the variables once, when the first session of a process is opened. They must not reach child processes,
    which may need other settings.
    """
    wanted = {_THREADS: threads, _MOST_AHEAD: _MOST_AHEAD_MS}
    added = {name: value for name, value in wanted.items() if name not in os.environ}
    os.environ.update(added)
    try:
        return zenoh.open(config)
    finally:
        for name in added:
            del os.environ[name]


def _config(mode: str, more: Mapping[str, object]) -> zenoh.Config:
    config = zenoh.Config()
    settings: dict[str, object] = {
        "mode": mode,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "scouting/delay": 0,
        "transport/shared_memory/enabled": False,
        "transport/link/tx/lease": round(LEASE_S * 1000),
        **more,
    }
    for key, value in settings.items():
        try:
            config.insert_json5(key, json.dumps(value))
        except zenoh.ZError as error:
            raise BusError(f"{key} cannot be set: {first_line(error)}") from None
    return config


def first_line(error: Exception) -> str:
    """The text of a Zenoh error, without the location in Zenoh's source."""
    return str(error).splitlines()[0].partition(" at /")[0][:200]
