"""The real thing: a replay process, a recorder process and its control on a real Zenoh network on loopback."""

import json
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator

import pytest
from websockets.sync.client import connect

LIMIT = 60.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""


@pytest.fixture
def start() -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Starts Python programs, and ends those that are left."""
    running: list[subprocess.Popen[str]] = []

    def start(*arguments: str) -> subprocess.Popen[str]:
        pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        running.append(subprocess.Popen([sys.executable, "-m", *arguments], text=True, **pipes))
        return running[-1]

    yield start
    for process in running:
        if process.returncode is None:
            process.kill()
            process.communicate()


@pytest.mark.processes
def test_the_command_serves_a_live_view_until_the_viewer_had_enough(recorded, start):
    replay = start(
        "touchline", "replay", str(recorded.path), "--fast", "--foxglove", "--foxglove-port", "0", *_ANYWHERE
    )
    address = next(line.split()[-1] for line in replay.stderr if "ws://" in line)
    with connect(address, subprotocols=["foxglove.sdk.v1"]) as socket:
        assert json.loads(socket.recv(timeout=LIMIT))["op"] == "serverInfo"
        offered = {channel["topic"] for channel in json.loads(socket.recv(timeout=LIMIT))["channels"]}
        assert {"/tf", "/viz/field", "/viz/robots"} <= offered
    replay.send_signal(signal.SIGINT)
    replay.communicate(timeout=LIMIT)
    assert replay.returncode == 128 + signal.SIGINT


_ANYWHERE = ("--listen", "tcp/127.0.0.1:0")
