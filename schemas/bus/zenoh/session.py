"""A Zenoh session as the host or a client has it: settings, threads, endpoint; opened, or refused in one line.

Multicast scouting, gossip and shared memory are off; a process listens on the address it was told and on nothing else.
"""

import json
import os
from dataclasses import dataclass

import zenoh

from schemas.bus.contract import LEASE_S, Bus, BusError
from schemas.bus.zenoh.wait_timer import WaitTimer
from schemas.process.clock import Clock

_THREADS = "ZENOH_RUNTIME"
"""Environment variable that Zenoh reads its threads from."""
_CLIENT_THREADS = "(app: (worker_threads: 1), rx: (handover: app), acc: (handover: app), tx: (handover: app))"
"""A field of many small processes has fewer cores than Zenoh would take threads."""
_HOST_THREADS = "(app: (worker_threads: 4), rx: (handover: app), acc: (handover: app), tx: (worker_threads: 1))"
"""Whoever waits for room in a link's queue, as an answer from a cache does, must not wait on the thread that makes the
room. Zenoh closes a link that makes no room on the threads that read: were they few, all of them could be waiting for
room in the dead link, and the host would stand still for good (eclipse-zenoh/zenoh, issue 1876)."""
_RETRY = {"period_init_ms": 20, "period_max_ms": 500, "period_increase_factor": 1.5}
_TRY_S = (0.5, 2.0)
"""One attempt to connect: the first, and the longest it doubles to, for a machine that is too busy to answer at once.
Between attempts Ctrl-C is heard."""
_ROOM_US = 1_000_000
"""Wall time that a client has to make room for what must not be dropped; then its link is cut and it may come again."""


@dataclass(frozen=True, slots=True)
class SessionContext:
    """A session as the writers and readers of one match use it."""

    session: zenoh.Session
    prefix: str
    """What stands before every key."""
    clock: Clock
    is_client: bool
    timer: WaitTimer
    """Ends waits that have an end."""
    owner: Bus
    """Has to be closed before the interpreter ends, and is there for as long as anything uses the session."""


def open_router(listen: str) -> zenoh.Session:
    """The host's session: a router that listens on one endpoint.

    Raises:
        BusError: the endpoint cannot be listened on.
    """
    config = _config(
        "router",
        {
            "listen/endpoints": [listen],
            "transport/link/tx/queue/congestion_control/block/wait_before_close": _ROOM_US,
        },
    )
    try:
        return _open(config, _HOST_THREADS)
    except zenoh.ZError as error:
        busy = "ddress already in use" in str(error)
        why = "is in use by another process" if busy else f"cannot be listened on ({error})"
        raise BusError(f"--listen {listen} {why}; choose another port, or tcp/127.0.0.1:0 for a free one") from None


def open_connection(connect: str, clock: Clock, patience: float) -> zenoh.Session:
    """A client's session, tried for `patience` s of wall time.

    Raises:
        BusError: no host answers at that endpoint.
    """
    deadline = clock.now() + patience
    lasts, longest = _TRY_S
    while True:
        settings = {"connect/endpoints": [connect], "connect/retry": _RETRY}
        config = _config("client", {**settings, "connect/timeout_ms": round(lasts * 1000)})
        try:
            return _open(config, _CLIENT_THREADS)
        except zenoh.ZError as error:
            if clock.now() >= deadline:
                raise BusError(
                    f"--connect {connect}: no host answers there; start one with `touchline host`, or name its endpoint"
                ) from error
            clock.sleep_until(clock.now() + 0.1)
            lasts = min(2 * lasts, longest)


def _open(config: zenoh.Config, threads: str) -> zenoh.Session:
    """Open a session in a process with these threads, unless its environment names others.

    Zenoh looks once, when its first session is opened; the variable must not reach processes launched from here, which
    may play another part.
    """
    if _THREADS in os.environ:
        return zenoh.open(config)
    os.environ[_THREADS] = threads
    try:
        return zenoh.open(config)
    finally:
        del os.environ[_THREADS]


def _config(mode: str, more: dict[str, object]) -> zenoh.Config:
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
            raise BusError(f"{key.split('/')[0]} is {value!r}: {first_line(error)}") from None
    return config


def first_line(error: Exception) -> str:
    """What a Zenoh error says, without the place in Zenoh's own source."""
    return str(error).splitlines()[0].partition(" at /")[0][:200]
