"""A match whose magenta team is started by another command, as on another machine."""

import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from support.brisk import BRISK
from support.process_story import Program, wait_for

pytestmark = pytest.mark.processes

CUP = f"""
name = "cup"
rules = "{BRISK}"
pace = "x8"
duration = 4
[teams]
magenta = {{ remote = true, size = 1, name = "Guests" }}
[teams.cyan]
size = 1
"""
LINES = """
import json, sys
print("briefed", json.loads(sys.stdin.readline())["robot"], file=sys.stderr, flush=True)
for line in sys.stdin:
    print(json.dumps({"answers_tick": json.loads(line)["tick"]}), flush=True)
"""
NUBOT = ["--brain", "robot_agent.teams.nubot:NuBot"]
Run = Callable[..., Program]


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Run]:
    """Starts a command, by default `touchline match cup.toml` on a free port."""
    (tmp_path / "cup.toml").write_text(CUP)
    programs: list[Program] = []

    def start(*words: str) -> Program:
        free = ["--listen", "tcp/127.0.0.1:0", "--insecure"] if words[0] == "match" else []
        environment = {"XDG_RUNTIME_DIR": str(tmp_path), "COLUMNS": "200"}
        programs.append(Program(["touchline", *words, *free], tmp_path, f"program{len(programs)}", environment))
        return programs[-1]

    yield start
    for program in programs:
        program.end()


def endpoint_of(match: Program) -> str:
    """The endpoint in the command that the match prints for the other side."""
    wait_for(lambda: "magenta joins with: touchline team magenta --connect " in match.out, f"{match.out} {match.err}")
    line = next(line for line in match.out.splitlines() if "--connect" in line)
    return line.split("--connect ")[1].split()[0]


def test_a_match_waits_for_its_remote_team_of_programs_and_both_ends_report_who_plays(run: Run, tmp_path: Path) -> None:
    (tmp_path / "robot.py").write_text(LINES)
    match = run("match", "cup.toml", "--no-record")
    endpoint = endpoint_of(match)
    wait_for(lambda: "waiting for magenta: no robot there; missing: magenta1" in match.out, match.out)
    team = run("team", "magenta", "--connect", endpoint, "--stdio", f"{sys.executable} robot.py")
    assert (match.status(), team.status()) == (0, 0), (match.err, team.err, team.out)
    assert "magenta1 joined: 1 of 1 robots of magenta are there" in match.out
    assert "Simple (cyan) – Guests (magenta)" in match.out
    assert team.out.splitlines()[1].startswith("magenta1 started; logs are in runs/cup-magenta-")
    assert team.out.endswith("the host is gone\n")
    (log,) = tmp_path.glob("runs/cup-magenta-*/magenta1.log")
    assert log.read_text() == "briefed magenta1\n"


def test_a_team_is_refused_with_the_reason_and_ctrl_c_ends_the_match_that_waits_for_it(run: Run) -> None:
    match = run("match", "cup.toml", "--no-record")
    at = ["--connect", endpoint_of(match)]
    wrong = {
        'the agent is for the match "final", and this host plays "cup"': run(
            "team", "magenta", *at, "--match", "final", *NUBOT
        ),
        "--robot magenta2: no robot of magenta has that name": run(
            "team", "magenta", *at, "--robot", "magenta2", *NUBOT
        ),
        'no robot of the match "cup" is named magenta7; did you mean "magenta1"?': run(
            "agent", *at, "--robot", "magenta7", *NUBOT
        ),
        "magenta1 is a robot of magenta, and the agent plays for cyan": run(
            "agent", *at, "--robot", "magenta1", "--side", "cyan", *NUBOT
        ),
    }
    for reason, program in wrong.items():
        assert program.status() == 2, (reason, program.err)
        assert reason in program.err
        assert program.err.count("\n") <= 2  # the second line reports a wait for the host
    match.popen.send_signal(signal.SIGINT)
    assert match.status() == 130
    assert "match interrupted" in match.err
    assert match.processes() == {}
    log = next(match.folder.glob("runs/cup-*-seed1/host.log")).read_text()
    reasons = [reason for reason in wrong if not reason.startswith("--robot")]
    assert [reason for reason in reasons if reason not in log] == []


def test_a_match_that_waits_in_vain_for_its_remote_team_ends_in_time(run: Run) -> None:
    match = run("match", "cup.toml", "--no-record", "--wait", "1")
    assert match.status() == 1
    assert "no robot of magenta joined within 1 s" in match.err
