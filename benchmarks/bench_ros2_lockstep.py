"""What a ROS 2 graph costs in lockstep: ten robots that one foreign process drives, against ten agents.

`python benchmarks/bench_ros2_lockstep.py --rounds 5` plays with agents in processes of their own, as a match does
without other settings, with agents in one process, and with nodes, in turns; it prints the medians of the ratios. The
nodes answer each `/clock` with a stamped command for each robot. Nothing is recorded, and nobody reads other topics.
"""

import argparse
import os
import statistics
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import NamedTuple

from bench_lockstep import MEASURE_S, cpu_seconds, newest, overrides
from bench_lockstep import measure as measure_processes
from idle_brain import act
from running_match import HERE, PATIENCE_S, launch

from robot_agent.process.brain_runner import BrainRunner
from robot_agent.process.claim import Membership
from robot_agent.process.runner import Member
from robot_agent.process.team_process import serve_team
from robot_agent.ros2.process import serve_robots
from robot_agent.sdk.contract import Brain
from runtime.bus.contract import Subscription
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from runtime.ros2.graph import Arrived, open_graph
from runtime.ros2.message_builder import MessageBuilder
from runtime.ros2.topic_type import CLOCK, TWIST_STAMPED
from schemas.config.match_config import load_match
from schemas.side import Side
from schemas.topics import HEALTH
from sim_host.server.settings import HostSettings

ROBOTS = 10
KINDS = ("processes", "agents", "nodes")
"""Agents in processes of their own, agents in one process, and nodes of one process."""


class Cost(NamedTuple):
    """What was measured in one match."""

    rate: float
    """Ticks per second."""
    host: float
    """CPU time of the host in a tick, in s."""
    robots: float
    """CPU time of the agents or of the bridge in a tick, in s."""
    nodes: float
    """CPU time of the nodes in a tick, in s."""


class _Idle:
    """A brain that answers at once."""

    act = staticmethod(act)


def run_agents(match: str, endpoint: str, robots: list[str]) -> None:
    """Play all robots in this process, as `process = "team"` does."""
    brain: Brain = _Idle()
    with open_client(match, WallClock(), endpoint, PATIENCE_S) as bus:

        def member(name: str, sights: Subscription) -> Member:
            membership = Membership(bus, name, None, match)
            runner = partial(BrainRunner, sights=sights)
            return Member(bus, lambda _: brain, name, PATIENCE_S, membership, runner)

        serve_team(bus, robots, member)


def run_bridge(match: str, endpoint: str, graph_endpoint: str, robots: list[str]) -> None:
    """Play all robots by the nodes of a graph."""
    clock = WallClock()
    with (
        open_client(match, clock, endpoint, PATIENCE_S) as bus,
        open_graph("touchline", clock, 0, graph_endpoint, None, PATIENCE_S) as graph,
    ):
        serve_robots(bus, graph, robots, 1, PATIENCE_S)


def run_nodes(graph_endpoint: str, robots: list[str]) -> None:
    """Answer each `/clock` at once, as the agents do, with a message that is encoded but for its stamp."""
    build = MessageBuilder()
    still = build.make(TWIST_STAMPED.message, build.header(build.stamp(0), ""), build.twist(0.0, 0.0, 0.0, 0.0))
    encoded = bytes(build.encode(still, TWIST_STAMPED))
    with open_graph("nodes", WallClock(), 0, None, graph_endpoint, PATIENCE_S) as graph:
        writers = [graph.publisher(f"/{robot}/cmd_vel", TWIST_STAMPED) for robot in robots]

        def answer(arrived: Arrived) -> None:
            message = encoded[:4] + arrived.payload[4:12] + encoded[12:]  # both begin with their stamp
            for writer in writers:
                writer.put(message)

        graph.subscribe("/clock", CLOCK, answer)
        threading.Event().wait()


def role(*words: str) -> "subprocess.Popen[bytes]":
    """Another process of this benchmark."""
    return subprocess.Popen([sys.executable, __file__, *words], cwd=HERE)


@contextmanager
def ended(processes: list["subprocess.Popen[bytes]"]) -> Iterator[None]:
    """End processes after the block, the last one first."""
    try:
        yield
    finally:
        for process in reversed(processes):
            process.kill()
            process.wait()


def measure(kind: str, foreign: list[str]) -> Cost:
    """Ticks per second with one of `KINDS`."""
    if kind == "processes":
        cycles = measure_processes(ROBOTS, "none")
        return Cost(cycles.rate, cycles.host, cycles.agents, 0.0)
    config = load_match(None, overrides(ROBOTS))
    endpoint, graph = with_free_port("tcp/127.0.0.1:0"), with_free_port("tcp/127.0.0.1:0")
    robots = [robot for side in Side for robot in config.robots(side)]
    processes = [launch("sim_host", HostSettings(config=config, listen=endpoint))]
    where = ("agents", config.name, endpoint) if kind == "agents" else ("bridge", config.name, endpoint, graph)
    with ended(processes), open_client(config.name, WallClock(), endpoint, PATIENCE_S) as bus:
        processes.append(role(*where, *robots))
        if kind != "agents":
            nodes = [sys.executable, "-W", "ignore", *foreign, graph, *robots]
            processes.append(subprocess.Popen(nodes) if foreign else role("nodes", graph, *robots))
        healths = bus.subscribe(HEALTH)
        while (received := healths.receive(PATIENCE_S)) is not None and received.message().tick < 500:
            pass
        first, before = newest(healths, 10.0), [cpu_seconds(one) for one in processes]
        threading.Event().wait(MEASURE_S)
        used = [cpu_seconds(one) - busy for one, busy in zip(processes, before, strict=True)]
        last = newest(healths, 10.0)
    assert first is not None and last is not None
    ticks = last.message().tick - first.message().tick
    rate = ticks / ((last.stamp.sent_ns - first.stamp.sent_ns) * 1e-9)  # type: ignore[union-attr]
    return Cost(rate, *[one / (rate * MEASURE_S) for one in [*used, 0.0][:3]])


def main() -> None:
    """Print ticks per second and CPU times of both, and the median of the ratios of rounds."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3, help="matches of each, in turns")
    parser.add_argument("--sdk", action="store_true", help="nodes of zenoh-ros2-sdk")
    options = parser.parse_args()
    foreign = [str(HERE.parent / "tests" / "support" / "ros_team.py"), "sdk"] if options.sdk else []
    rows: list[dict[str, Cost]] = []
    for _ in range(options.rounds):
        rows.append({kind: measure(kind, foreign) for kind in KINDS})
        print("  " + ", ".join(f"{kind} {cost.rate:.0f}" for kind, cost in rows[-1].items()) + " ticks/s", flush=True)
    for kind in KINDS:
        rate, *times = (statistics.median(column) for column in zip(*[row[kind] for row in rows], strict=True))
        host, robots, nodes = (f"{1e6 * one:.0f} us" for one in times)
        print(f"{kind:9} {rate:.0f} ticks/s; CPU time a tick: host {host}, robots {robots}, nodes {nodes}")
    for kind in KINDS[:2]:
        ratios = [row["nodes"].rate / row[kind].rate for row in rows]
        limit = "; at least 0.9" if kind == "processes" else ""
        print(
            f"nodes / {kind}: {statistics.median(ratios):.3f} ({min(ratios):.3f} to {max(ratios):.3f}{limit}), "
            f"on {os.cpu_count()} cores"
        )


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["agents", name, endpoint, *robots]:
            run_agents(name, endpoint, robots)
        case ["bridge", name, endpoint, graph, *robots]:
            run_bridge(name, endpoint, graph, robots)
        case ["nodes", graph, *robots]:
            run_nodes(graph, robots)
        case _:
            main()
