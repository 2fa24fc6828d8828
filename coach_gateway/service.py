"""The services of the gateway's process. They share one connection to the bus, and run until they are stopped.

The process waits for a host for any length of time. It stays when the host leaves, and its link reconnects by itself.
"""

import asyncio
import contextlib
import signal
from collections.abc import Callable, Sequence
from typing import Protocol

from schemas.bus.contract import Bus, BusError
from schemas.bus.endpoint import parse_endpoint
from schemas.bus.zenoh.bus import open_client
from schemas.process.clock import WallClock

_POLL_S = 1.0
"""s of wall time that one attempt to find a host lasts."""


class Service(Protocol):
    """One bridge between the match and people or programs."""

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set, and leave nothing open.

        Raises:
            TouchlineError: the service cannot start; then the whole process ends with that one line.
        """


def run(
    connect: str | None,
    match: str | None,
    make: Callable[[Bus], Sequence[Service]],
    log: Callable[[str], None],
    waiting_page: Service | None = None,
) -> None:
    """Connect to the host and run the services until SIGINT or SIGTERM; `waiting_page` is served until there is a host.

    Raises:
        TouchlineError: a service cannot start, or it is not clear which match is meant.
    """
    if connect is not None:
        parse_endpoint(connect)
    asyncio.run(_run(connect, match, make, log, waiting_page))


async def _run(
    connect: str | None,
    match: str | None,
    make: Callable[[Bus], Sequence[Service]],
    log: Callable[[str], None],
    waiting_page: Service | None,
) -> None:
    stop = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, stop.set)
    bus = await _connect(connect, match, stop)
    if bus is None and not stop.is_set():
        log(f"no host {f'at {connect}' if connect is not None else 'on this machine'} yet; waiting for it")
        bus = await _wait(connect, match, stop, waiting_page)
    if bus is not None:
        with bus:
            await together(make(bus), stop)


async def _wait(
    connect: str | None, match: str | None, stop: asyncio.Event, waiting_page: Service | None
) -> Bus | None:
    """A connection to the match, after any length of time; None once `stop` is set."""
    met = asyncio.Event()
    waiting = asyncio.create_task(waiting_page.serve(met)) if waiting_page is not None else None
    bus = None
    try:
        while bus is None and not stop.is_set():
            bus = await _connect(connect, match, stop)
    finally:
        met.set()
        if waiting is not None:
            await waiting
    return bus


async def _connect(connect: str | None, match: str | None, stop: asyncio.Event) -> Bus | None:
    """A connection to the match; None if no host answers within one attempt."""
    try:
        bus: Bus = await asyncio.to_thread(open_client, match, WallClock(), connect, _POLL_S)
    except BusError:
        return None
    if stop.is_set():
        bus.close()
        return None
    return bus


async def together(services: Sequence[Service], stop: asyncio.Event) -> None:
    """Run services concurrently; if one fails, the others are stopped and its error is raised."""
    tasks = [asyncio.create_task(service.serve(stop)) for service in services]
    done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_EXCEPTION)
    if any(task.exception() is not None for task in done):
        stop.set()
        await asyncio.wait(tasks)
    for task in tasks:
        task.result()


async def pause(stop: asyncio.Event, seconds: float) -> bool:
    """Wait `seconds` of wall time, or until `stop` is set; whether it is."""
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(stop.wait(), seconds)
    return stop.is_set()
