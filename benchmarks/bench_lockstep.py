"""Lockstep: sense-act cycles per second of agent processes that answer at once, and what limits them.

`--robots` sets the numbers of robots. With several, the matches run in turns, and the last number is compared with the
first: 22 robots should reach at least half of the cycles of ten. `--access none credentials tls` compares hosts that
admit everybody, ask for credentials, or encrypt as well: in turns with the same number of robots.
"""

import argparse
import os
import statistics
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from running_match import ACCESS, PATIENCE_S, running_match

from runtime.bus.contract import ReceivedMessage, Subscription
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.topics import HEALTH

SETTLE_S = 2.0
MEASURE_S = 8.0
TARGET = 500
"""Cycles per second with ten robots."""
LEAST_RATIO = 0.5


@dataclass(frozen=True)
class Cycles:
    """What was measured in one match."""

    rate: float
    """Cycles per second."""
    real_time: float
    """Simulated time by wall time."""
    host: float
    """CPU time of the host in a cycle, s."""
    agents: float
    """CPU time of all agents in a cycle, s."""


def cpu_seconds(process: subprocess.Popen[bytes]) -> float:
    """User and system time of a process so far."""
    fields = Path(f"/proc/{process.pid}/stat").read_text().rsplit(") ", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def overrides(robots: int) -> dict[str, Any]:
    """The settings of a match with this number of robots, the greater half cyan's."""
    sizes = {"cyan": {"size": robots - robots // 2}, "magenta": {"size": robots // 2}}
    settings = {"duration": 3600.0, "teams": sizes, "patience": {"attendance": PATIENCE_S}}
    return settings | ({"rules": "eleven"} if robots > 10 else {})


def newest(healths: Subscription, wait: float) -> ReceivedMessage | None:
    """The newest report on the host's health; waits for one if there is none."""
    last = healths.receive(wait)
    while (received := healths.receive()) is not None:
        last = received
    return last


def measure(robots: int, access: str) -> Cycles:
    """Cycles of a match with this number of robots."""
    with (
        running_match("idle_brain:act", overrides(robots), access) as (config, endpoint, host, agents, viewer),
        open_client(config.name, WallClock(), endpoint, PATIENCE_S, viewer) as bus,
    ):
        healths = bus.subscribe(HEALTH)
        while (received := healths.receive(PATIENCE_S)) is not None and received.message().tick < 100:
            pass
        time.sleep(SETTLE_S)
        first = newest(healths, 10.0)
        busy, busy_agents = cpu_seconds(host), sum(map(cpu_seconds, agents))
        time.sleep(MEASURE_S)
        busy, busy_agents = cpu_seconds(host) - busy, sum(map(cpu_seconds, agents)) - busy_agents
        last = newest(healths, 10.0)
        assert first is not None and last is not None
        silent = [name for name, robot in last.message().robots.items() if not robot.answering]
        if silent:
            raise SystemExit(f"not measured with {robots} robots: no answers from {', '.join(silent)}")
        ticks = last.message().tick - first.message().tick
        span = (last.stamp.sent_ns - first.stamp.sent_ns) * 1e-9  # type: ignore[union-attr]
        cycles = ticks / span * MEASURE_S
        real_time = ticks / span * config.load_profile().time.tick
    return Cycles(ticks / span, real_time, busy / cycles, busy_agents / cycles)


def median(rows: list[Cycles]) -> Cycles:
    """The median of each figure."""
    return Cycles(*[statistics.median(column) for column in zip(*[vars(row).values() for row in rows], strict=True)])


def compare_access(robots: int, kinds: list[str], rounds: int) -> None:
    """Print cycles per second of each kind of protection, and the median of its ratios to the first in each round."""
    rows = [{kind: measure(robots, kind) for kind in kinds} for _ in range(rounds)]
    for kind in kinds:
        ratios = [row[kind].rate / row[kinds[0]].rate for row in rows]
        cycles = median([row[kind] for row in rows])
        print(
            f"{kind}: {cycles.rate:.0f} cycles/s with {robots} agents, {statistics.median(ratios):.3f} of {kinds[0]} "
            f"({min(ratios):.3f} to {max(ratios):.3f}); host {cycles.host * 1e6:.0f} us a cycle"
        )


def main() -> None:
    """Print cycles per second of each number of robots, and the ratio of the last to the first."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=int, nargs="+", default=[10, 22], help="numbers of robots, by default 10 22")
    parser.add_argument("--rounds", type=int, default=1, help="matches of each number, in turns")
    parser.add_argument("--access", choices=ACCESS, nargs="+", default=["none"], help="how the host is protected")
    options = parser.parse_args()
    if len(options.access) > 1:
        compare_access(options.robots[0], options.access, options.rounds)
        return
    (access,) = options.access
    rounds = [{robots: measure(robots, access) for robots in options.robots} for _ in range(options.rounds)]
    for robots in options.robots:
        cycles = median([row[robots] for row in rounds])
        target = f", {cycles.rate / TARGET:.2f} x the target of {TARGET}" if robots == 10 else ""
        print(
            f"lockstep: {cycles.rate:.0f} cycles/s with {robots} agent processes{target}, {cycles.real_time:.1f} x "
            f"real time; CPU time of a cycle: host {cycles.host * 1e6:.0f} us, agents {cycles.agents * 1e6:.0f} us, of "
            f"{os.cpu_count()} cores for {1e6 / cycles.rate:.0f} us"
        )
    first, *_, last = options.robots[:1] + options.robots
    if first != last:
        ratio = statistics.median(row[last].rate / row[first].rate for row in rounds)
        print(f"cycles with {last} robots / with {first}: {ratio:.2f} (at least {LEAST_RATIO})")


if __name__ == "__main__":
    main()
