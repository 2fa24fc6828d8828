"""The cost of 200 spectators for the host: its CPU time per tick with their pages open and without, in one run.

Ten agents in real time, the page's server, and one process that reads all pages and discards the data. Both cases take
turns, so that other load of the machine affects both.
"""

import asyncio
import base64
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

from running_match import HERE, launch, running_match

from coach_gateway.settings import GatewaySettings
from coach_gateway.web.settings import WebSettings
from runtime.bus.contract import Subscription
from runtime.bus.endpoint import reserve_port
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.messages.health import Health
from schemas.topics import HEALTH

PAGES = 200
ROUNDS = 3
SECONDS = 6.0
_TICKS_A_SECOND = os.sysconf("SC_CLK_TCK")


def cpu_s(pid: int) -> float:
    """User and system time of a process so far, in s."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS_A_SECOND


def newest(healths: Subscription) -> Health:
    """The host's newest health message."""
    received = healths.receive(30.0)
    assert received is not None
    while (more := healths.receive()) is not None:
        received = more
    health: Health = received.message()
    return health


def measure(host: int, server: int, healths: Subscription) -> tuple[float, float, float]:
    """CPU time of the host in ms per tick, late ticks per second, and the server's share of a core."""
    began, before, served = time.perf_counter(), newest(healths), cpu_s(server)
    host_s = cpu_s(host)
    time.sleep(SECONDS)
    after = newest(healths)
    host_s, served, lasted = cpu_s(host) - host_s, cpu_s(server) - served, time.perf_counter() - began
    late = (after.late_ticks - before.late_ticks) / lasted
    return 1000.0 * host_s / (after.tick - before.tick), late, served / lasted


def with_pages(port: int, host: int, server: int, healths: Subscription) -> tuple[float, float, float, float]:
    """The same with all pages open, and the frames per second that each page received."""
    readers = subprocess.Popen(
        [sys.executable, __file__, str(port)], cwd=HERE, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert readers.stdin is not None and readers.stdout is not None
    assert readers.stdout.readline() == "all there\n"
    figures = measure(host, server, healths)
    frames = float(readers.communicate("leave\n")[0])
    return (*figures, frames)


def main() -> None:
    """Print the cost for host and server with and without spectators."""
    with (
        running_match("idle_brain:act", {"duration": 3600.0, "pace": "realtime"}) as (config, endpoint, host, *_),
        open_client(config.name, WallClock(), endpoint, 60.0) as bus,
    ):
        port = reserve_port("127.0.0.1")
        settings = GatewaySettings(connect=endpoint, match=config.name, web=WebSettings(port=port))
        server = launch("coach_gateway", settings)
        try:
            healths = bus.subscribe(HEALTH)
            while newest(healths).tick < 100:
                pass
            rounds = [
                (measure(host.pid, server.pid, healths), with_pages(port, host.pid, server.pid, healths))
                for _ in range(ROUNDS)
            ]
        finally:
            server.terminate()
            server.wait()
    alone, late_alone, _ = map(statistics.median, zip(*(without for without, _ in rounds), strict=True))
    crowd, late_crowd, share, frames = map(statistics.median, zip(*(many for _, many in rounds), strict=True))
    print(
        f"spectators: the host uses {crowd:.2f} ms of CPU per tick with {PAGES} pages open, {alone:.2f} without, "
        f"ratio {crowd / alone:.2f} (at most 1.10); late ticks per second {late_crowd:.1f} and {late_alone:.1f}; "
        f"each page receives {frames:.0f} frames per second, the page's server uses {share:.0%} of a core"
    )


async def read_pages(port: int) -> None:
    """Open all pages, report it on stdout, read until a line arrives on stdin; print frames per second and page."""
    counts = [0] * PAGES

    async def read(number: int, opened: asyncio.Event) -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        key = base64.b64encode(os.urandom(16)).decode()
        writer.write(
            f"GET /ws HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: http://127.0.0.1:{port}\r\nUpgrade: websocket\r\n"
            f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
        )
        assert b" 101 " in await reader.readuntil(b"\r\n\r\n")
        opened.set()
        while True:
            _, length = await reader.readexactly(2)
            if length == 126:
                length = int.from_bytes(await reader.readexactly(2))
            elif length == 127:
                length = int.from_bytes(await reader.readexactly(8))
            counts[number] += (await reader.readexactly(length)).startswith(b'{"kind":"frame"')

    opened = [asyncio.Event() for _ in range(PAGES)]
    tasks = [asyncio.create_task(read(number, event)) for number, event in enumerate(opened)]
    await asyncio.gather(*(event.wait() for event in opened))
    print("all there", flush=True)
    began, before = time.perf_counter(), sum(counts)
    await asyncio.to_thread(sys.stdin.readline)
    print((sum(counts) - before) / PAGES / (time.perf_counter() - began))
    for task in tasks:
        task.cancel()


if __name__ == "__main__":
    main() if len(sys.argv) == 1 else asyncio.run(read_pages(int(sys.argv[1])))
