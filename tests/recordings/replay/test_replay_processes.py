"""The real thing: a replay process with a live view for viewers, or a page."""

import json
import signal

import pytest
from websockets.sync.client import connect

from runtime.access.credentials import HOST_FILE, new_credentials, write_credentials
from support.foreign import drive, write_mcap
from support.visitor import Visitor

LIMIT = 60.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""


@pytest.mark.processes
def test_the_command_serves_a_live_view_until_the_viewer_had_enough(recorded, start):
    replay = start(
        "-m", "touchline", "replay", str(recorded.path), "--fast", "--foxglove", "--foxglove-port", "0", *_ANYWHERE
    )
    address = next(line.split()[-1] for line in replay.stderr if "ws://" in line)
    with connect(address, subprotocols=["foxglove.sdk.v1"]) as socket:
        assert json.loads(socket.recv(timeout=LIMIT))["op"] == "serverInfo"
        offered = {channel["topic"] for channel in json.loads(socket.recv(timeout=LIMIT))["channels"]}
        assert {"/tf", "/viz/field", "/viz/robots"} <= offered
    replay.send_signal(signal.SIGINT)
    replay.communicate(timeout=LIMIT)
    assert replay.returncode == 128 + signal.SIGINT


@pytest.mark.processes
@pytest.mark.parametrize("protected", [False, True], ids=["open", "with passwords"])
def test_the_command_serves_page_and_live_view_of_a_file_without_a_match(tmp_path, start, protected):
    file = write_mcap(tmp_path / "log.mcap", drive(50))
    words = [str(file), "--paused", "--web", "--web-port", "0", "--foxglove", "--foxglove-port", "0"]
    if protected:
        write_credentials(tmp_path, new_credentials())
        words += ["--credentials", str(tmp_path / HOST_FILE)]
    replay = start("-m", "touchline", "replay", *words, *_ANYWHERE)
    view = next(line.split()[-1] for line in replay.stderr if "ws://" in line)
    address, _, token = next(line.split()[-1] for line in replay.stderr if "page:" in line).partition("/#token=")
    page = Visitor(address, token, patience=LIMIT)
    assert [topic["key"] for topic in page.hear("welcome", live=False)["topics"]] == ["robot1/odom"]
    assert page.ask("replay", request={"operation": "seek", "to": "0.3"})["answer"]["time"] == 0.3
    assert page.ask("replay", request={"operation": "play"})["accepted"]
    while page.hear("replay")["replay"]["time"] < 0.49:
        pass
    with connect(view, subprotocols=["foxglove.sdk.v1"]) as socket:
        assert json.loads(socket.recv(timeout=LIMIT))["op"] == "serverInfo"
        assert [one["topic"] for one in json.loads(socket.recv(timeout=LIMIT))["channels"]] == ["robot1/odom"]
    page.close()
    replay.send_signal(signal.SIGINT)
    replay.communicate(timeout=LIMIT)
    assert replay.returncode == 128 + signal.SIGINT


_ANYWHERE = ("--listen", "tcp/127.0.0.1:0")
