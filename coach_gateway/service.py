"""The services of the gateway's process. They share one connection to the bus, and run until they are stopped.

The process waits for a host for any length of time. It stays when the host leaves, and its link reconnects by itself.
"""

import asyncio
import contextlib
import signal
from collections.abc import Callable, Sequence
from typing import Protocol

from schemas.access.accounts import Account
from schemas.bus.contract import Bus, BusError
from schemas.bus.settings import ClientSettings
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
    client: ClientSettings,
    make: Callable[[Bus], Sequence[Service]],
    log: Callable[[str], None],
    waiting_page: Service | None = None,
) -> None:
    """Connect to the host and run the services until SIGINT or SIGTERM; `waiting_page` is served until there is a host.

    Raises:
        TouchlineError: a service cannot start, or it is not clear which match is meant.
    """
    asyncio.run(_run(client, make, log, waiting_page))


async def _run(
    client: ClientSettings,
    make: Callable[[Bus], Sequence[Service]],
    log: Callable[[str], None],
    waiting_page: Service | None,
) -> None:
    stop = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, stop.set)
    bus = await _connect(client, stop)
    if bus is None and not stop.is_set():
        where = f"at {client.connect}" if client.connect is not None else "on this machine"
        log(f"no host {where} yet; waiting for it")
        bus = await _wait(client, stop, waiting_page)
    if bus is not None:
        with bus:
            await together(make(bus), stop)


async def _wait(client: ClientSettings, stop: asyncio.Event, waiting_page: Service | None) -> Bus | None:
    """A connection to the match, after any length of time; None once `stop` is set."""
    met = asyncio.Event()
    waiting = asyncio.create_task(waiting_page.serve(met)) if waiting_page is not None else None
    bus = None
    try:
        while bus is None and not stop.is_set():
            bus = await _connect(client, stop)
    finally:
        met.set()
        if waiting is not None:
            await waiting
    return bus


async def _connect(client: ClientSettings, stop: asyncio.Event) -> Bus | None:
    """A connection to the match; None if no host answers within one attempt."""

    def join() -> Bus:
        account = Account.OPERATOR  # it officiates, and gives the orders of both coaches
        return open_client(client.match, WallClock(), client.connect, _POLL_S, client.credentials, account)

    try:
        bus = await asyncio.to_thread(join)
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
