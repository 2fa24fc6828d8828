"""Clients reach a host over IPv4 and IPv6, and a port that is filtered, closed or without a route is one clear line."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from support.namespaces import Network, network
from support.process_story import LIMIT, wait_for

pytestmark = pytest.mark.processes

ROOT = Path(__file__).parents[2]
SMALL = "[teams.cyan]\nsize = 1\n[teams.magenta]\nsize = 1\n"


@pytest.fixture
def net(tmp_path: Path) -> Iterator[Network]:
    (tmp_path / "small.toml").write_text(SMALL)
    with network("host", "robot") as machines:
        yield machines


def run(net: Network, machine: str, folder: Path, *words: str) -> tuple["subprocess.Popen[bytes]", Path]:
    """A touchline command on a machine, and the file of its output."""
    log = folder / f"{machine}-{len(list(folder.glob('*.out')))}.out"
    environment = {**os.environ, "XDG_RUNTIME_DIR": str(folder), "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-P", "-m", "touchline", *words]
    with log.open("wb") as out:
        program = net.run(machine, command, cwd=folder, env=environment, stdout=out, stderr=subprocess.STDOUT)
    return program, log


def test_a_host_on_every_address_takes_ipv6_and_ipv4(net: Network, tmp_path: Path) -> None:
    host, log = run(net, "host", tmp_path, "host", "small.toml", "--listen", "tcp/[::]:7447", "--insecure")
    wait_for(lambda: "on tcp/[::]:7447" in log.read_text(), log.read_text())
    for address in (net.address("host"), f"[{net.address6('host')}]"):
        at = f"tcp/{address}:7447"
        state, said = run(net, "robot", tmp_path, "parameters", "list", "--connect", at, "--json")
        assert state.wait(LIMIT) == 0, said.read_text()
    agents = [
        run(net, "robot", tmp_path, "agent", "--robot", robot, "--connect", f"tcp/{address}:7447", "--brain", brain)
        for robot, address, brain in (
            ("cyan1", net.address("host"), "robot_agent.teams.simple:Simple"),
            ("magenta1", f"[{net.address6('host')}]", "robot_agent.teams.nubot:NuBot"),
        )
    ]
    for robot in ("cyan1", "magenta1"):
        wait_for(lambda robot=robot: f"{robot} joined: process " in log.read_text(), log.read_text())
    for program, _ in (*agents, (host, log)):
        program.terminate()
        assert program.wait(LIMIT) == 0


@pytest.mark.parametrize(
    ("endpoint", "words"),
    [
        ("tcp/10.77.0.1:7447", "--connect tcp/10.77.0.1:7447: no host answers there"),
        ("tcp/10.99.0.1:7447", "no way there from this machine (Network is unreachable)"),
        ("tcp/10.77.0.99:7447", "no way there from this machine (No route to host)|nothing answers there"),
        ("tcp/simhost:7447", 'the name "simhost" has no address here'),
    ],
    ids=["no host", "no route", "no machine", "no name"],
)
def test_an_agent_that_reaches_no_host_ends_with_one_line(
    net: Network, tmp_path: Path, endpoint: str, words: str
) -> None:
    command = ("agent", "--robot", "cyan1", "--connect", endpoint, "--patience", "0", "--brain", "a:B")
    program, log = run(net, "robot", tmp_path, *command)
    assert program.wait(LIMIT) == 2
    lines = log.read_text().splitlines()
    assert any(word in lines[-1] for word in words.split("|")), lines
    assert len([line for line in lines if line.startswith("touchline: ")]) == 1
