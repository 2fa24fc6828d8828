"""What attacks on the host's port cost the others: ticks a second before, during and after, CPU time, and memory.

Each attack runs as a process of its own against a fresh lockstep match of four robots.
"""

import argparse
import contextlib
import math
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

from running_match import PATIENCE_S, running_match

from runtime.bus.contract import Bus
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.messages.health import Health
from schemas.topics import HEALTH
from schemas.wire.message import BadMessageError

ATTACKER = Path(__file__).parents[1] / "tests/support/attacker.py"


def memory_mb(pid: int) -> float:
    """Resident memory of a process, MB."""
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1024
    return 0.0


def cpu_s(pid: int) -> float:
    """CPU time of a process and all its threads, s."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return math.nan
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Rate(NamedTuple):
    """The progress of a match over some seconds."""

    ticks: float
    """Ticks a second of wall time."""
    cpu_ms: float
    """The host's CPU time for each tick, which depends less on the other load of the machine."""


class Gauge:
    """Measures the rate of a running match by its health."""

    def __init__(self, bus: Bus, pid: int) -> None:
        self._pid = pid
        self._healths = bus.subscribe(HEALTH)
        self.newest: Health | None = None

    def ticks(self) -> int:
        """The newest tick that the host has reported, -1 before the first."""
        while (received := self._healths.receive()) is not None:
            with contextlib.suppress(BadMessageError):  # an attacker's
                self.newest = received.message()
        return self.newest.tick if self.newest is not None else -1

    def rate(self, seconds: float) -> Rate:
        """The rate over this time."""
        first, began, used = self.ticks(), time.monotonic(), cpu_s(self._pid)
        time.sleep(seconds)
        ticks = self.ticks() - first
        return Rate(ticks / (time.monotonic() - began), 1e3 * (cpu_s(self._pid) - used) / max(ticks, 1))


def measure(attack: str, seconds: float, robots: int) -> str:
    """The row of one attack."""
    sizes = {"cyan": {"size": robots // 2}, "magenta": {"size": robots // 2}}
    settings = {"duration": 3600.0, "teams": sizes, "patience": {"attendance": PATIENCE_S}}
    with (
        running_match("idle_brain:act", settings) as (config, endpoint, host, *_),
        open_client(config.name, WallClock(), endpoint, PATIENCE_S) as bus,
    ):
        gauge = Gauge(bus, host.pid)
        while gauge.ticks() < 100:
            time.sleep(0.1)
        before, memory = gauge.rate(seconds), memory_mb(host.pid)
        attacker = subprocess.Popen([sys.executable, str(ATTACKER), attack, endpoint, config.name, str(seconds + 1)])
        during = gauge.rate(seconds)
        most = memory_mb(host.pid)
        attacker.terminate()
        attacker.wait()
        time.sleep(1.0)
        after = gauge.rate(seconds)
        lived = host.poll() is None
        most = max(most, memory_mb(host.pid)) if lived else most
        accounts = gauge.newest.accounts if gauge.newest is not None else {}
    measured = (before, during, after)
    rates = " | ".join([*(f"{one.ticks:.0f}" for one in measured), *(f"{one.cpu_ms:.2f}" for one in measured)])
    row = f"| {attack} | {rates} | {most - memory:+.0f} MB | {'yes' if lived else 'NO'} |"
    return f"{row} {accounts}" if os.environ.get("VERBOSE") else row


def main() -> None:
    """Print a row for each attack."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("attacks", nargs="*", help="names of attacks, by default all")
    parser.add_argument("--seconds", type=float, default=4.0, help="duration of each measurement")
    parser.add_argument("--robots", type=int, default=4)
    options = parser.parse_args()
    sys.path.insert(0, str(ATTACKER.parent))
    from attacker import ATTACKS, CONTROLS, RAW_ATTACKS

    headings = (
        "attack",
        "ticks/s before",
        "during",
        "after",
        "CPU ms/tick before",
        "during",
        "after",
        "memory",
        "host lives",
    )
    print("|", " | ".join(headings), "|\n|", " | ".join("---" for _ in headings), "|")
    for attack in options.attacks or [*ATTACKS, *RAW_ATTACKS, *CONTROLS]:
        print(measure(attack, options.seconds, options.robots), flush=True)


if __name__ == "__main__":
    main()
