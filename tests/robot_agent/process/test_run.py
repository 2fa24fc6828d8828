import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from robot_agent.process.settings import AgentSettings
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_host
from runtime.process.clock import WallClock
from runtime.process.settings_file import write_settings
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.topics import COMMAND, SETUP, SIGHT
from support.process_story import descendants, is_running, wait_for
from touchline.commands.cli.command_line import app

BRAIN = "robot_agent.teams.nubot:NuBot"
LIMIT_S = 60.0
"""To start, a process takes a second of a core: many, where others want it, too."""


@pytest.mark.processes
def test_without_a_host_the_process_ends_with_one_line_and_status_2():
    nobody = with_free_port("tcp/127.0.0.1:0")
    settings = AgentSettings(connect=nobody, match="m", robot="cyan1", brain=BRAIN, patience=0)
    ended = subprocess.run(
        [sys.executable, "-m", "robot_agent", "--settings", "-"],
        input=settings.model_dump_json(),
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )
    assert ended.returncode == 2
    assert ended.stderr.count("\n") == 1
    assert f"--connect {nobody}: no host answers there" in ended.stderr


def by_settings(endpoint: str, folder: Path) -> tuple[list[str], dict[str, str]]:
    """The command line and the environment of a robot's process that reads a settings file."""
    file = folder / "cyan2.json"
    write_settings(AgentSettings(connect=endpoint, match="friendly", robot="cyan2", brain=BRAIN), file)
    return ["robot_agent", "--settings", str(file)], {}


def by_environment(endpoint: str, folder: Path) -> tuple[list[str], dict[str, str]]:
    """The command line and the environment of `touchline agent` without options."""
    told = {"CONNECT": endpoint, "MATCH": "friendly", "ROBOT": "cyan2", "BRAIN": BRAIN}
    return ["touchline", "agent"], {f"TOUCHLINE_{name}": value for name, value in told.items()}


PROGRAM = """
import json, sys
robot = json.loads(sys.stdin.readline())["robot"]
for line in sys.stdin:
    print(json.dumps({"answers_tick": json.loads(line)["tick"], "refuses_order": robot}), flush=True)
"""


@contextmanager
def answering_robot(
    endpoint: str, words: list[str], setup: Setup, sight: Sight, **options: Any
) -> Iterator[tuple[subprocess.Popen[bytes], Command]]:
    """A robot's process that has answered a sight of a host, and its command; it ends without a word, with status 0."""
    with open_host("friendly", WallClock(), endpoint) as host:
        server, presence = host.serve(SETUP), host.watch_alive()
        commands, sights = host.subscribe(COMMAND), host.publisher(SIGHT, robot="cyan2")
        robot = subprocess.Popen([sys.executable, "-m", *words], stderr=subprocess.PIPE, **options)
        try:
            query = server.receive(LIMIT_S)
            assert query is not None
            query.reply(setup)
            arrived = presence.receive(LIMIT_S)
            assert arrived is not None and (arrived.kind, arrived.name) == ("agent", "cyan2")
            received = None
            while received is None:
                sights.put(sight)
                received = commands.receive(0.2)
            yield robot, received.message()
        finally:
            robot.terminate()
            _, said = robot.communicate(timeout=LIMIT_S)
    assert robot.returncode == 0, said.decode()
    assert said == b""


@pytest.mark.processes
def test_a_program_of_lines_answers_a_host_and_ends_with_its_agent(setup, sight_of, tmp_path):
    (tmp_path / "robot.py").write_text(PROGRAM)
    endpoint = with_free_port("tcp/127.0.0.1:0")
    words = ["touchline", "agent", "--connect", endpoint, "--match", "friendly", "--robot", "cyan2"]
    words += ["--stdio", f"{sys.executable} robot.py"]
    with answering_robot(endpoint, words, setup, sight_of(3), cwd=tmp_path) as (robot, command):
        assert (command.answers_tick, command.refuses_order) == (3, "cyan2")
        (program,) = descendants(robot.pid)
    wait_for(lambda: not is_running(program), "the end of the program")


@pytest.mark.parametrize("words", [[], ["--brain", "a:B", "--stdio", "cat"]])
def test_an_agent_has_a_brain_or_a_program(words):
    found = CliRunner().invoke(app, ["agent", "--robot", "cyan1", *words])
    assert found.exit_code == 2
    assert "a robot has a brain or a program; give --brain module:Class or --stdio" in found.output


@pytest.mark.processes
@pytest.mark.parametrize(("told", "polite"), [(by_environment, signal.SIGTERM), (by_settings, signal.SIGINT)])
def test_a_robot_answers_a_host_and_ends_politely(setup, sight_of, tmp_path, told, polite):
    endpoint = with_free_port("tcp/127.0.0.1:0")
    words, environment = told(endpoint, tmp_path)
    with answering_robot(endpoint, words, setup, sight_of(3), env=os.environ | environment) as (robot, command):
        assert command.answers_tick == 3
        robot.send_signal(polite)
        robot.wait(LIMIT_S)
