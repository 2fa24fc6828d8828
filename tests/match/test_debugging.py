"""Brains under development in real matches: a breakpoint, and changed code."""

import shlex
import subprocess
import sys

import pytest

from support.brisk import BRISK
from support.process_story import wait_for

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

MATCH = f"""
seed = 7
rules = "{BRISK}"
duration = 3

[teams.cyan]
size = 1
brain = "my_team:Stops"

[teams.magenta]
size = 1

[patience]
answer = 60
"""
BRAIN = """
from robot_agent.teams.simple import Simple

class Stops(Simple):
    def act(self, sight):
        if sight.tick >= 40:
            breakpoint()
        return super().act(sight)
"""


def test_the_command_that_a_match_shows_for_a_breakpoint_stops_there(start, tmp_path):
    (tmp_path / "match.toml").write_text(MATCH)
    (tmp_path / "my_team.py").write_text(BRAIN)
    match = start("touchline", "match", "match.toml", "--listen", "tcp/127.0.0.1:0", folder=tmp_path)
    assert match.status() == 0, match.err
    (line,) = (line for line in match.out.splitlines() if "breakpoint()" in line)
    assert line.startswith("breakpoint() at my_team.py, line 7, was skipped: cyan1 has no terminal; to stop there: ")
    words = shlex.split(line.partition("to stop there: ")[2])
    assert words[-3:] == ["--from", "tick:40", "--pdb"]
    stopped = subprocess.run(
        [sys.executable, "-m", *words, "--to", "tick:40"],
        cwd=tmp_path,
        input="p 'before', sight.tick\nc\np 'at the breakpoint', sight.tick\nc\n",
        capture_output=True,
        text=True,
        timeout=90,
        check=False,
    )
    assert "('before', 40)" in stopped.stdout, stopped.stderr
    assert "('at the breakpoint', 40)" in stopped.stdout
    assert stopped.stdout.splitlines()[-1].startswith("identical"), stopped.stderr
    assert stopped.returncode == 0


VERSION = """
from robot_agent.teams.simple import Simple

class Stops(Simple):
    def __init__(self, briefing):
        super().__init__(briefing)
        print("version", {})
"""


def test_an_edited_brain_plays_from_the_next_reset_on(start, endpoint, tmp_path):
    (tmp_path / "match.toml").write_text(MATCH.replace("duration = 3", "duration = 600"))
    brain = tmp_path / "my_team.py"
    brain.write_text(VERSION.format(1))
    words = ("--reload", "--pace", "realtime", "--listen", endpoint)
    match = start("touchline", "match", "match.toml", *words, folder=tmp_path, name="reloads", PYTHONUNBUFFERED="1")

    def wait_for_log(line):
        wait_for(lambda: any(line in log.read_text() for log in tmp_path.glob("runs/*/cyan1.log")), line)

    wait_for_log("version 1")
    wait_for(lambda: "START" in match.out, f"START in: {match.out}")
    for number, (source, shown) in enumerate(
        [
            (VERSION.format(2), "episode 2 is played with the changed my_team.py: cyan1 has a new brain"),
            ("def", "episode 3 is played with old brains, the changed my_team.py is broken: cyan1: brain is"),
            (VERSION.format(4), "episode 4 is played with the changed my_team.py: cyan1 has a new brain"),
        ]
    ):
        brain.write_text(source)
        reset = start("touchline", "scene", "reset", "--connect", endpoint, folder=tmp_path, name=f"reset{number}")
        assert reset.status() == 0, reset.err
        wait_for(lambda shown=shown: shown in match.out, f"{shown} in: {match.out}, {match.err}")
    wait_for_log("version 4")
