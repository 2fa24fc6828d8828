"""Sight → command → host in real time, against a zenoh-python ping-pong of equal sizes and as many processes.

Both send ten messages of a sight's size every 20 ms to ten processes; each process replies with one of a command's
size. Both measure from just before the first is sent to the time of reception at the router. They run one after the
other.
"""

import json
import statistics
import struct
import subprocess
import sys
import time

import zenoh
from running_match import HERE, running_match

from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.topics import HEALTH

ROBOTS = 10
PERIOD_S = 0.02
SIGHT_BYTES = 1300
COMMAND_BYTES = 140
SECONDS = 8


def ours() -> float:
    """Median latency over all robots and reports of the host's health, in ms."""
    with (
        running_match("idle_brain:act", {"duration": 3600.0, "pace": "realtime"}) as (config, endpoint, *_),
        open_client(config.name, WallClock(), endpoint) as bus,
    ):
        healths = bus.subscribe(HEALTH)
        while (received := healths.receive(30.0)) is not None and received.message().tick < 100:
            pass
        time.sleep(SECONDS)
        latencies = []
        while (received := healths.receive()) is not None:
            latencies += [robot.latency_ms for robot in received.message().robots.values() if robot.latency_ms]
    return statistics.median(latencies)


def settings(mode: str, **more: object) -> zenoh.Config:
    """The configuration of Touchline's own bus."""
    config = zenoh.Config()
    quiet = {"mode": mode, "scouting/multicast/enabled": False, "scouting/gossip/enabled": False, "scouting/delay": 0}
    for key, value in {**quiet, "transport/shared_memory/enabled": False, **more}.items():
        config.insert_json5(key.replace("__", "/"), json.dumps(value))
    return config


def raw() -> float:
    """Median latency of the ping-pong, in ms."""
    endpoint = with_free_port("tcp/127.0.0.1:0")
    session = zenoh.open(settings("router", listen__endpoints=[endpoint]))
    players = [
        subprocess.Popen([sys.executable, __file__, endpoint, str(number)], cwd=HERE) for number in range(ROBOTS)
    ]
    try:
        pongs = session.declare_subscriber("raw/*/pong", zenoh.handlers.FifoChannel(100_000))
        pings = [session.declare_publisher(f"raw/{number}/ping") for number in range(ROBOTS)]
        latencies: list[float] = []
        for tick in range(round((SECONDS + 2) / PERIOD_S)):
            began, sent_ns = time.perf_counter(), time.time_ns()
            for ping in pings:
                ping.put(struct.pack("<QQ", tick, sent_ns).ljust(SIGHT_BYTES))
            time.sleep(max(0.0, PERIOD_S - (time.perf_counter() - began)))
            while (pong := pongs.try_recv()) is not None:
                then = struct.unpack_from("<QQ", pong.payload.to_bytes())[1]
                latencies.append((pong.timestamp.get_time_as_ntp64().as_nanos() - then) * 1e-6)
        return statistics.median(latencies[len(latencies) // 5 :])
    finally:
        for player in players:
            player.terminate()
            player.wait()
        session.close()


def play(endpoint: str, number: str) -> None:
    """One process of the ping-pong: replies to each ping."""
    with zenoh.open(settings("client", connect__endpoints=[endpoint])) as session:
        pings = session.declare_subscriber(f"raw/{number}/ping", zenoh.handlers.RingChannel(1))
        pong = session.declare_publisher(f"raw/{number}/pong")
        for ping in pings:
            pong.put(ping.payload.to_bytes()[:16].ljust(COMMAND_BYTES))


def main() -> None:
    """Print both medians and their ratio."""
    rounds = [(ours(), raw()) for _ in range(2)]
    mine, theirs = (statistics.median(column) for column in zip(*rounds, strict=True))
    print(
        f"latency: sight to command at the host p50 {mine:.2f} ms, raw ping-pong {theirs:.2f} ms, "
        f"ratio {mine / theirs:.2f} (at most 2.5), ten agent processes in real time"
    )


if __name__ == "__main__":
    main() if len(sys.argv) == 1 else play(*sys.argv[1:])
