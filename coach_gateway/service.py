"""The services of the gateway's process: they share one seat on the bus and run until they are told to stop.

The process waits for a host however long that takes, and stays when the host goes: its link comes back by itself.
"""

import asyncio
import signal
from collections.abc import Callable, Sequence
from typing import Protocol

from schemas.bus.contract import Bus, BusError
from schemas.bus.endpoint import parse_endpoint
from schemas.bus.zenoh_bus import open_client
from schemas.clock import Clock, WallClock

_LOOK_S = 1.0
"""s of wall time that one attempt to find a host lasts."""


class Service(Protocol):
    """One bridge between the match and people or programs."""

    async def serve(self, stop: asyncio.Event) -> None:
        """Serve until `stop` is set, and leave nothing open.

        Raises:
            TouchlineError: it cannot begin; then the whole process ends with that one line.
        """


def run(connect: str, match: str, make: Callable[[Bus], Sequence[Service]], say: Callable[[str], None]) -> None:
    """Meet the host and run the services until SIGINT or SIGTERM comes.

    Raises:
        TouchlineError: a service cannot begin.
    """
    parse_endpoint(connect)
    bus = _meet(connect, match, WallClock(), say)
    if bus is None:
        return
    with bus:
        asyncio.run(_serve(make(bus)))


def _meet(connect: str, match: str, clock: Clock, say: Callable[[str], None]) -> Bus | None:
    """A seat in the match; nothing when Ctrl-C came first."""
    told = False
    try:
        while True:
            try:
                return open_client(match, clock, connect, _LOOK_S)
            except BusError:
                if not told:
                    told = True
                    say(f"no host at {connect} yet; waiting for it")
    except KeyboardInterrupt:
        return None


async def _serve(services: Sequence[Service]) -> None:
    stop = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, stop.set)
    await together(services, stop)


async def together(services: Sequence[Service], stop: asyncio.Event) -> None:
    """Run services beside each other; where one fails, the others are told to stop, and its error is raised."""
    tasks = [asyncio.create_task(service.serve(stop)) for service in services]
    done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_EXCEPTION)
    if any(task.exception() is not None for task in done):
        stop.set()
        await asyncio.wait(tasks)
    for task in tasks:
        task.result()
