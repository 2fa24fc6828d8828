"""What agents that join and leave cost a host in real time: how late its ticks begin, with them and without.

    python benchmarks/bench_joins.py [SECONDS]

Ten agents join at the same time and leave 0.5 s later, again and again, half of them by ending without a word. They
claim their robots as agents do, and do not answer, so that no brain takes part in the measurement. Quiet and busy
stretches take turns, so that other load on the machine meets both.
"""

import collections
import contextlib
import signal
import subprocess
import sys
import threading
import time

from robot_agent.process.claim import Membership
from robot_agent.process.runner import ask_setup
from runtime.bus.zenoh.bus import ZenohBus, open_client, open_host
from runtime.process.clock import WallClock
from schemas.config.match_config import load_match
from schemas.side import Side
from schemas.topics import COMMAND, SIGHT
from sim_host.server.host import Host

AT_ONCE = 10
STAY_S = 0.5
STRETCH_S = 5.0
EDGES_MS = (1, 2, 5, 10, 20, 50)


def measured(seconds: float) -> None:
    """Play a match in real time, and print how late its ticks began in quiet and in busy stretches."""
    config = load_match(None, {"duration": 86_400.0, "pace": "realtime", "patience.attendance": 0.0})
    with open_host(config.name, WallClock(), "tcp/127.0.0.1:0") as bus:
        host = Host(config, bus)
        host.wait_for_all()
        host.begin()
        period = host.simulation.profile.time.tick
        late: dict[bool, list[float]] = {False: [], True: []}
        work: dict[bool, list[float]] = {False: [], True: []}
        joined = 0
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            for busy in (False, True):
                crowd = subprocess.Popen([sys.executable, __file__, bus.endpoint]) if busy else None
                end, due = time.monotonic() + STRETCH_S, None
                while time.monotonic() < end:
                    began = time.monotonic()
                    spent = time.thread_time()
                    host.tick()
                    work[busy].append((time.thread_time() - spent) * 1e3)
                    ended = time.monotonic()
                    late[busy].append(max(0.0, ended - began - period) * 1e3 if due else 0.0)
                    due = ended
                    joined += sum(stats.alive for stats in host.inbox.agent_stats.values()) if busy else 0
                if crowd is not None:
                    crowd.send_signal(signal.SIGTERM)
                    crowd.wait()
        print(f"agents were present in {joined} robot-ticks")
        for busy in (False, True):
            name, worst = "joins" if busy else "quiet", max(work[busy])
            print(f"{name}: {histogram(late[busy])}; CPU of a tick, worst {worst:.1f} ms")
        host.simulation.close()


def histogram(late: list[float]) -> str:
    """How many ticks took this many ms more than their period."""
    counts: collections.Counter[str] = collections.Counter()
    for one in late:
        counts[next((f"<{edge}" for edge in EDGES_MS if one < edge), f">={EDGES_MS[-1]}")] += 1
    bins = [*(f"<{edge}" for edge in EDGES_MS), f">={EDGES_MS[-1]}"]
    return f"{len(late)} ticks, ms over the period: " + ", ".join(f"{bin} {counts[bin]}" for bin in bins)


def crowd(endpoint: str) -> None:
    """Join with ten agents and leave, again and again."""
    robots = [f"{side}{number}" for side in Side for number in range(1, 6)][:AT_ONCE]
    clock = WallClock()
    while True:
        buses: list[ZenohBus] = []

        def join(robot: str, buses: list[ZenohBus] = buses) -> None:
            bus = open_client(None, clock, endpoint)
            setup = ask_setup(bus, 10.0)
            bus.subscribe(SIGHT, robot=robot), bus.publisher(COMMAND, robot=robot)
            Membership(bus, robot, None).join(setup, 10.0)
            buses.append(bus)

        threads = [threading.Thread(target=join, args=(robot,)) for robot in robots]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        time.sleep(STAY_S)
        for bus in buses:
            with contextlib.suppress(Exception):
                bus.close()
        time.sleep(STAY_S)


if __name__ == "__main__":
    argument = sys.argv[1] if len(sys.argv) > 1 else "60"
    crowd(argument) if "/" in argument else measured(float(argument))
