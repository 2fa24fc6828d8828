"""The page on any MCAP and any keys: its commands, as they stand, on files and a network of others."""

import json
import shlex
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from time import monotonic

import numpy as np
import pytest
import zenoh
from mcap.reader import make_reader
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from typer.testing import CliRunner, Result

from support.foreign import LIMIT, START_NS, Network, drive, write_mcap
from touchline.commands.cli.command_line import app

THERE = "tcp/192.168.1.5:7447"


@pytest.fixture
def network(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Network]:
    """A router, and the working folder with two logs, one of them cut off, and a bag of rosbags."""
    monkeypatch.chdir(tmp_path)
    write_mcap(tmp_path / "robot1.mcap", drive(50))
    write_mcap(tmp_path / "again.mcap", drive(50, step=11))
    cut = write_mcap(tmp_path / "robot2.mcap", drive(2000, "robot2"), chunk_size=10_000)
    cut.write_bytes(cut.read_bytes()[:-500])
    store = get_typestore(Stores.ROS2_JAZZY)
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as bag:
        for topic in ("/robot3/goal", "/robot3/home"):
            connection = bag.add_connection(topic, "geometry_msgs/msg/Point", typestore=store)
            for number in range(50):
                point = store.types["geometry_msgs/msg/Point"](*np.arange(3.0) + number)
                cdr = store.serialize_cdr(point, "geometry_msgs/msg/Point")
                bag.write(connection, START_NS + number * 10_000_000, cdr)
    network = Network()
    yield network
    network.close()


@pytest.fixture
def lines(root: Path, fenced: Callable[[str, str], list[str]]) -> list[str]:
    page = (root / "docs" / "any_mcap.md").read_text("utf-8")
    return [line for piece in fenced(page, "sh") for line in piece.splitlines()]


def touchline(line: str, network: Network) -> Result:
    words = shlex.split(line.replace(THERE, network.endpoint))[1:]
    if words[0] == "replay" and "--connect" not in words:
        words += ["--connect", network.endpoint]
    return CliRunner().invoke(app, words, prog_name="touchline")


@pytest.mark.processes
def test_every_command_of_the_page_runs_as_it_stands(network, lines):
    recorded, *others = lines
    recorder = subprocess.Popen(
        [sys.executable, "-m", *shlex.split(recorded.replace(THERE, network.endpoint))],
        stdout=subprocess.PIPE,
        text=True,
    )
    network.wait_for_subscriber("robot/1/odom")
    publisher = network.session.declare_publisher("robot/1/odom", encoding="application/json")
    for number in [*range(40), *range(50, 60)]:
        publisher.put(b'{"x":%d}' % number, source_info=zenoh.SourceInfo(publisher.id, number))
    network.received(50)
    deadline = monotonic() + LIMIT
    while Path("fleet.mcap").stat().st_size < 600 and monotonic() < deadline:
        pass  # until the first messages are flushed
    recorder.send_signal(signal.SIGINT)
    assert "50 messages on 1 keys, 10 lost" in recorder.communicate(timeout=LIMIT)[0]
    said = {line: touchline(line, network) for line in others}
    assert {line: one.output for line, one in said.items() if one.exit_code} == {}
    output = {" ".join(line.split()[1:3]): one.output for line, one in said.items()}
    assert "robot/1/odom" in output["info fleet.mcap"] and "50, 10 lost" in output["info fleet.mcap"]
    assert {one["encoding"] for one in json.loads(output["info robot1.mcap"])["channels"]} == {"json", "cdr"}
    assert output["diff robot1.mcap"] == "identical: 50 messages on 1 keys\n"
    assert "repaired, 2000 messages" in output["recover robot2.mcap"]
    keys = [str(one.key_expr) for one in network.received(50 + 50 + 2000 + 42)]
    assert keys[:50] == ["robot/1/odom"] * 50
    assert {"test/spare/odom", "test/robot2/odom", "robot3/goal"} <= {*keys}
    assert keys.count("robot3/goal") == 21  # 0.1 to 0.3 s
    with Path("odometry.mcap").open("rb") as file:
        assert len(list(make_reader(file).iter_messages())) == 50
