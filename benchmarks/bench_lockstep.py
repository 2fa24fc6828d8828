"""Lockstep: sense-act cycles per second of ten agent processes that answer at once, and what limits them."""

import os
import time
from pathlib import Path

from running_match import running_match

from schemas.bus.zenoh.bus import open_client
from schemas.process.clock import WallClock
from schemas.topics import HEALTH

SETTLE_S = 2.0
MEASURE_S = 8.0


def cpu_seconds(process: int) -> float:
    """User and system time of a process so far."""
    fields = Path(f"/proc/{process}/stat").read_text().rsplit(") ", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main() -> None:
    """Print cycles per second, their ratio to the target, and the host's share of one core."""
    with (
        running_match("idle_brain:act", {"duration": 3600.0}) as (config, endpoint, host),
        open_client(config.name, WallClock(), endpoint) as bus,
    ):
        healths = bus.subscribe(HEALTH)
        while (received := healths.receive(30.0)) is not None and received.message().tick < 100:
            pass
        time.sleep(SETTLE_S)
        while healths.receive() is not None:
            pass
        first, busy, began = healths.receive(10.0), cpu_seconds(host.pid), time.perf_counter()
        time.sleep(MEASURE_S)
        busy, took = cpu_seconds(host.pid) - busy, time.perf_counter() - began
        last = first
        while (received := healths.receive()) is not None:
            last = received
        assert first is not None and last is not None
        ticks = last.message().tick - first.message().tick
        span = (last.stamp.sent_ns - first.stamp.sent_ns) * 1e-9  # type: ignore[union-attr]
        rate = ticks / span
    factor = rate * config.load_profile().time.tick
    print(
        f"lockstep: {rate:.0f} cycles/s with ten agent processes, {rate / 500:.2f} x the target of 500, {factor:.1f} x "
        f"real time; limited by the CPU: the host uses {busy / took:.0%} of a core, "
        f"the agents the rest of {os.cpu_count()}"
    )


if __name__ == "__main__":
    main()
