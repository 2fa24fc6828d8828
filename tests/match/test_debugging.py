"""A brain with a breakpoint in a real match, and the command that the terminal shows for it."""

import shlex
import subprocess
import sys

import pytest

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

MATCH = """
seed = 7
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
