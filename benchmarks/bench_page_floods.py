"""What floods of one client of the page's port cost another page: how long its requests wait, and its frames.

Server and attacker are processes of their own. The attacker opens its next connection as soon as one is closed.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from coach_gateway.web.settings import WebSettings
from schemas.bus.in_process_bus import SharedState
from schemas.topics import WORLD
from support.fake_host import FakeHost
from support.messages import make_robot, make_world
from support.page_gateway import Gateway, tokens_in
from support.raw_client import RawClient, deflated, frame
from support.visitor import Visitor

PING, CONTINUED = 9, 0
FLOODS = {
    "none": b"",
    "pings": frame(b"p" * 125, PING) * 500,
    "bombs": frame(deflated(b"x" * 250_000), compressed=True) * 200,
    "garbage": frame(b"\xff\xfe") * 100,
    "fragments": frame(b"{", fin=False) + frame(b"", CONTINUED, fin=False) * 5000,
    "messages": frame(b"{}") * 500,
    "long messages": frame(b"x" * 60_000) * 20,
    "connections": b"",
}
"""Flood → what is sent again and again."""
EVENTS = 100
"""Past events, which every page that opens is sent."""
ASK_S = 0.1
"""Wall time between two requests of the page."""


def serve() -> None:
    """Serve the page of a match of ten robots, with a world fifty times a second."""
    medium = SharedState()
    host = FakeHost(medium, in_threads=True)
    with tempfile.TemporaryDirectory() as folder:
        gateway = Gateway(medium, WebSettings(port=0), tokens_in(Path(folder)))
        print(gateway.origin, flush=True)
        for number in range(EVENTS):
            host.tell(f"event {number}")
        names = [robot for team in host.setup.teams.values() for robot in team.robots]
        for tick in range(sys.maxsize):
            host.say()
            host.put(WORLD, make_world(tick, robots={name: make_robot(0.01 * (tick % 300)) for name in names}))
            time.sleep(0.02)


def attack(flood: str, origin: str) -> None:
    """Flood without end."""
    while True:
        with suppress(OSError):
            client = RawClient(int(origin.rpartition(":")[2]))
            client.upgrade(origin, Sec_WebSocket_Extensions="permessage-deflate")
            while FLOODS[flood] and client.send(FLOODS[flood]) and not client.is_closed:
                pass
            client.close()


def watch(page: Visitor, seconds: float) -> tuple[list[float], list[float]]:
    """The waits of requests and the times between frames of an honest page, in ms."""
    waits, frames, asked = [], [], dict[int, float]()
    begin = last = time.monotonic()
    while (now := time.monotonic()) - begin < seconds:
        if now - begin >= len(asked) * ASK_S:
            number = page.say("scene", request={"operation": "reset"})  # which is refused, as it is no referee
            asked[number] = now
        with suppress(TimeoutError):
            message = json.loads(page.socket.recv(ASK_S / 2))
            now = time.monotonic()
            if message["kind"] == "reply":
                waits.append(1e3 * (now - asked[message["id"]]))
            elif message["kind"] == "frame":
                frames.append(1e3 * (now - last))
                last = now
    return waits, frames


def share(values: Sequence[float], part: float) -> float:
    """The value that this part of the values do not exceed."""
    return sorted(values)[int(part * (len(values) - 1))]


def main() -> None:
    """Print a row for each flood."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=6.0, help="wall time of each flood")
    parser.add_argument("--floods", nargs="*", default=list(FLOODS), choices=list(FLOODS))
    arguments = parser.parse_args()
    print(
        "| flood | reply p50, ms | reply p90, ms | frames p50, ms | frames p90, ms |\n| --- | --- | --- | --- | --- |"
    )
    for flood in arguments.floods:
        server = subprocess.Popen([sys.executable, __file__, "serve"], stdout=subprocess.PIPE, text=True)
        assert server.stdout is not None
        origin = server.stdout.readline().strip()
        programs = [server]
        page = Visitor(origin)  # before the flood, which uses up the connections of its network
        page.hear_what_is_played()
        try:
            if flood != "none":
                programs.append(subprocess.Popen([sys.executable, __file__, "attack", flood, origin]))
            time.sleep(1.0)
            waits, frames = watch(page, arguments.seconds)
            page.close()
        finally:
            for program in programs:
                program.kill()
                program.wait()
        figures = [share(waits, 0.5), share(waits, 0.9), share(frames, 0.5), share(frames, 0.9)]
        print(f"| {flood} | {figures[0]:.1f} | {figures[1]:.1f} | {figures[2]:.0f} | {figures[3]:.0f} |", flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["serve"]:
        serve()
    elif sys.argv[1:2] == ["attack"]:
        attack(*sys.argv[2:])
    else:
        main()
