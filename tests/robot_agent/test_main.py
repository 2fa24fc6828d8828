import os
import signal
import subprocess
import sys

import pytest

from robot_agent.__main__ import main
from schemas.bus.endpoint import with_free_port
from schemas.bus.zenoh.bus import open_host
from schemas.process.clock import WallClock
from schemas.topics import COMMAND, SETUP, SIGHT

BRAIN = "robot_agent.teams.nubot:NuBot"
LIMIT_S = 60.0
"""To start, a process takes a second of a core: many, where others want it, too."""


@pytest.fixture
def bare(monkeypatch):
    for name in ("CONNECT", "MATCH", "ROBOT", "BRAIN"):
        monkeypatch.delenv(f"TOUCHLINE_{name}", raising=False)


@pytest.mark.parametrize("missing", ["match", "robot", "brain"])
def test_a_missing_option_is_asked_for_by_name(bare, capsys, missing):
    given = {"match": "m", "robot": "cyan1", "brain": BRAIN}
    del given[missing]
    with pytest.raises(SystemExit) as ended:
        main([word for name, value in given.items() for word in (f"--{name}", value)])
    assert ended.value.code == 2
    assert f"--{missing}" in capsys.readouterr().err


@pytest.mark.processes
def test_without_a_host_the_process_ends_with_one_line_and_status_2():
    arguments = ["--match", "m", "--robot", "cyan1", "--brain", BRAIN, "--patience", "0"]
    nobody = with_free_port("tcp/127.0.0.1:0")
    ended = subprocess.run(
        [sys.executable, "-m", "robot_agent", "--connect", nobody, *arguments],
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )
    assert ended.returncode == 2
    assert ended.stderr.count("\n") == 1
    assert f"--connect {nobody}: no host answers there" in ended.stderr


@pytest.mark.processes
@pytest.mark.parametrize("polite", [signal.SIGTERM, signal.SIGINT])
def test_a_robot_configured_by_the_environment_answers_a_host_and_ends_cleanly(setup, sight_of, polite):
    endpoint = with_free_port("tcp/127.0.0.1:0")
    told = {"CONNECT": endpoint, "MATCH": "friendly", "ROBOT": "cyan2", "BRAIN": BRAIN}
    environment = os.environ | {f"TOUCHLINE_{name}": value for name, value in told.items()}
    with open_host("friendly", WallClock(), endpoint) as host:
        server, presence = host.serve(SETUP), host.watch_alive()
        commands, sights = host.subscribe(COMMAND), host.publisher(SIGHT, robot="cyan2")
        robot = subprocess.Popen([sys.executable, "-m", "robot_agent"], env=environment, stderr=subprocess.PIPE)
        try:
            query = server.receive(LIMIT_S)
            assert query is not None
            query.reply(setup)
            arrived = presence.receive(LIMIT_S)
            assert arrived is not None and (arrived.kind, arrived.name) == ("agent", "cyan2")
            received = None
            while received is None:
                sights.put(sight_of(3))
                received = commands.receive(0.2)
            assert received.message().answers_tick == 3
        finally:
            robot.send_signal(polite)
            _, said = robot.communicate(timeout=LIMIT_S)
    assert robot.returncode == 0, said.decode()
    assert said == b""
