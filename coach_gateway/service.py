"""The services of the gateway's process. They share one connection to the bus, and run until they are stopped.

The process waits for a host for any length of time. It stays when the host leaves, and its link reconnects by itself.
"""

import asyncio
import contextlib
import signal
from collections.abc import Awaitable, Callable, Sequence
from typing import Any, Protocol

from coach_gateway.timing import HOST_RETRY_S
from runtime.access.accounts import Account
from runtime.bus.contract import Bus, BusError
from runtime.bus.settings import ClientSettings
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock


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
    others: Sequence[Service] = (),
) -> None:
    """Run `others` and, once there is a host, the services that `make` returns, until SIGINT or SIGTERM.

    Raises:
        TouchlineError: a service cannot start, or it is not clear which match is meant.
    """
    asyncio.run(_run([_Connected(client, make, log), *others]))


async def _run(services: Sequence[Service]) -> None:
    stop = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, stop.set)
    await together(services, stop)


class _Connected:
    """The services that need a connection to the bus."""

    def __init__(
        self, client: ClientSettings, make: Callable[[Bus], Sequence[Service]], log: Callable[[str], None]
    ) -> None:
        self._client, self._make, self._log = client, make, log

    async def serve(self, stop: asyncio.Event) -> None:
        """Wait for a host for any length of time, then run the services."""
        bus = await self._connect(stop)
        if bus is None and not stop.is_set():
            where = f"at {self._client.connect}" if self._client.connect is not None else "on this machine"
            self._log(f"no host {where} yet; waiting for it")
        while bus is None and not stop.is_set():
            bus = await self._connect(stop)
        if bus is not None:
            with bus:
                await together(self._make(bus), stop)

    async def _connect(self, stop: asyncio.Event) -> Bus | None:
        """A connection to the match; None if no host answers within one attempt."""
        client = self._client

        def join() -> Bus:
            account = Account.OPERATOR  # it officiates, and gives the orders of both coaches
            return open_client(client.match, WallClock(), client.connect, HOST_RETRY_S, client.credentials, account)

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
    done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_EXCEPTION) if tasks else (set(), None)
    if any(task.exception() is not None for task in done):
        stop.set()
        await asyncio.wait(tasks)
    for task in tasks:
        task.result()


async def until_first(*works: Awaitable[Any], ignored: type[Exception] | tuple[type[Exception], ...] = ()) -> None:
    """Run works concurrently until one has ended, and cancel the others; raises an error that is not `ignored`."""
    tasks = [asyncio.ensure_future(work) for work in works]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        ends = await asyncio.gather(*tasks, return_exceptions=True)
    for end in ends:
        if isinstance(end, Exception) and not isinstance(end, ignored):
            raise end


async def pause(stop: asyncio.Event, seconds: float) -> bool:
    """Wait `seconds` of wall time, or until `stop` is set; whether it is."""
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(stop.wait(), seconds)
    return stop.is_set()
