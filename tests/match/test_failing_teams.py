"""Matches with teams that cannot play, as their writers see them: what is printed, and the status."""

import os
from pathlib import Path

import pytest

from recordings.reading.recording import open_recording

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

TEAM = """
from touchline import Command

class Still:
    def __init__(self, briefing):
        self.robot = briefing.robot

    def act(self, sight):
        return Command(answers_tick=sight.tick)

class Raises(Still):
    def act(self, sight):
        raise ValueError("no plan")
"""


@pytest.fixture
def play(start, tmp_path):
    """Plays a short match of a team of two against one robot that stands still; returns the program, ended."""

    def play(brain: str, seconds: float = 2.0, process: str = "robot"):
        (tmp_path / "team.py").write_text(TEAM)
        (tmp_path / "match.toml").write_text(
            f'duration = {seconds}\n[teams.cyan]\nname = "Lions"\nbrain = "team:{brain}"\nsize = 2\n'
            f'process = "{process}"\n[teams.magenta]\nname = "Tigers"\nbrain = "team:Still"\nsize = 1\n'
        )
        words = ("match", "match.toml", "--listen", "tcp/127.0.0.1:0")
        program = start("touchline", *words, folder=tmp_path, name=brain)
        program.status()
        return program

    return play


def test_a_team_whose_robots_all_fail_at_once_ends_the_match_with_the_reason_and_a_whole_recording(play, tmp_path):
    program = play("Raises", 600.0)
    assert program.status() == 1
    assert program.out.count("failed at its first sight; not started again: act raised at tick 0 (team.py") == 1
    line = program.err.splitlines()[-1]  # a busy machine reports the wait for the brains before it
    assert line.startswith("touchline: match ended ")
    fault = "act raised at tick 0 (team.py, line 13): ValueError: no plan"
    assert f"no robot of Lions (cyan) is left; cyan1: {fault}; logs are in runs/" in line
    (recording,) = tmp_path.glob("runs/*/match.mcap")
    assert open_recording(recording).complete


def test_a_team_in_one_process_ends_with_the_robot_that_fails_and_the_match_with_it(play, tmp_path):
    program = play("Raises", 600.0, "team")
    assert program.status() == 1
    assert program.out.count("cyan failed at its first sight; not started again: ") == 1
    line = program.err.splitlines()[-1]
    assert "no robot of Lions (cyan) is left; cyan: act raised at tick 0 (team.py, line 13): ValueError" in line
    (log,) = tmp_path.glob("runs/*/cyan.log")
    assert "has failed, and with it the process of its team" in log.read_text()


def test_a_recorder_without_a_host_reports_that_it_waits_and_can_be_interrupted(start, tmp_path):
    program = start("touchline", "record", "--connect", "tcp/127.0.0.1:9", "--out", "x.mcap", folder=tmp_path)
    program.wait_for_error("no host answers there")
    assert "waiting for it for up to 30 s" in program.err
    os.kill(program.popen.pid, 2)
    assert program.status() == 1
    assert program.err.splitlines()[-1] == "stopped before there was a host; nothing is recorded"
    assert list(Path(tmp_path).glob("*.mcap*")) == []
