"""The real thing: a replay process, a recorder process and its control on a real Zenoh network on loopback."""

import json
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator

import pytest
from websockets.sync.client import connect

from recordings.reading.recording import open_recording
from schemas.bus.endpoint import with_free_port
from schemas.bus.zenoh.bus import open_client
from schemas.messages.replay import ReplayOperation, ReplayRequest
from schemas.process.clock import WallClock
from schemas.topics import REPLAY_CONTROL

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
def test_record_replay_record_gives_equal_payloads_in_equal_order(recorded, start, tmp_path):
    endpoint, again = with_free_port("tcp/127.0.0.1:0"), tmp_path / "again.mcap"
    at = ("--match", "again", "--connect", endpoint)
    listen = ("--listen", endpoint, "--match", "again")
    replay = start("touchline", "replay", str(recorded.path), "--fast", "--paused", "--json", *listen)
    with open_client("again", WallClock(), endpoint, LIMIT) as bus:
        watch = bus.watch_alive()
        recorder = start("touchline", "record", *at, "--out", str(again))
        while (presence := watch.receive(LIMIT)) is not None and presence.kind != "recorder":
            continue
        assert presence is not None
        request = ReplayRequest(operation=ReplayOperation.PLAY)
        assert bus.query(REPLAY_CONTROL, request, LIMIT).result(LIMIT).paused is False
    played, error = replay.communicate(timeout=LIMIT)
    assert replay.returncode == 0, error
    every = list(recorded.messages())
    assert json.loads(played)["messages"] == len(every)
    _, error = recorder.communicate(timeout=LIMIT)
    assert (recorder.returncode, error) == (0, "")
    recording = open_recording(again, whole=True)
    facts = [(one.key, one.payload, one.log_ns) for one in every]
    assert [(one.key, one.payload, one.log_ns) for one in recording.messages()] == facts
    assert recording.result.lost == 0


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
