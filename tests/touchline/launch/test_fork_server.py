"""Robots that are forked from one process, against those that are launched by their command lines: nobody can tell."""

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from schemas.process.clock import WallClock
from touchline.launch.child_process import ChildProcess, ProcessHandle
from touchline.launch.fork_server import ForkedProcess, ForkServer
from touchline.launch.processes import PROCESSES, Process, ProcessKind

pytestmark = [
    pytest.mark.processes,
    pytest.mark.skipif(sys.platform != "linux", reason="robots are raised by means of the Linux kernel"),
]
_LIMIT_S = 120.0
_NOBODY = "tcp/127.0.0.1:1"
"""An endpoint at which no host will ever answer."""
_ENDED = (0, -signal.SIGTERM)
"""How a robot ends that is told to: by itself, or before it could listen."""
_WAITS = ("--connect", _NOBODY, "--match", "test", "--brain", "no:Brain", "--patience", "600")


def robot(name: str, *arguments: str, **environment: str) -> Process:
    command = (sys.executable, "-m", "robot_agent", "--robot", name, *arguments)
    return Process(name, ProcessKind.AGENT, command, {"PYTHONHASHSEED": "0", **environment})


def wait_for(true: Callable[[], bool]) -> None:
    clock = WallClock()
    deadline = clock.now() + _LIMIT_S
    while not true():
        assert clock.now() < deadline
        clock.sleep_until(clock.now() + 0.01)


def end_of(launched: ProcessHandle) -> int:
    """The exit status, once it has ended."""
    wait_for(lambda: launched.status() is not None)
    status = launched.status()
    assert status is not None
    return status


def is_running(pid: int) -> bool:
    """Whether a process exists and is no zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def words_of(pid: int) -> list[str]:
    """Its command line, as lists of processes show it."""
    return Path(f"/proc/{pid}/cmdline").read_bytes().decode().rstrip("\0").split("\0")


@pytest.fixture
def fork_server(tmp_path: Path) -> Iterator[ForkServer]:
    fork_server = ForkServer(tmp_path / "fork_server.log")
    yield fork_server
    fork_server.close()


def test_a_robot_has_its_own_arguments_log_and_exit_status(fork_server: ForkServer, tmp_path: Path) -> None:
    helped = fork_server.launch(robot("cyan1", "--help"), tmp_path / "cyan1.log")
    wrong = fork_server.launch(robot("cyan2", "--no-such-word"), tmp_path / "cyan2.log")
    assert isinstance(helped, ForkedProcess)
    assert (end_of(helped), end_of(wrong)) == (0, 2)
    assert "usage: python -m robot_agent" in (tmp_path / "cyan1.log").read_text()
    assert "required: --match" in wrong.last_lines(1)[0]


def test_a_robot_has_its_own_environment(fork_server: ForkServer, tmp_path: Path) -> None:
    fork_server.launch(robot("cyan1", "--help"), tmp_path / "cyan1.log")
    told = fork_server.launch(robot("cyan2", "--help", TOUCHLINE_MATCH="final"), tmp_path / "cyan2.log")
    assert end_of(told) == 0
    assert "TOUCHLINE_MATCH; default: final" in " ".join((tmp_path / "cyan2.log").read_text().split())


def test_a_robot_is_called_by_its_own_command_line_and_leads_its_own_group(
    fork_server: ForkServer, tmp_path: Path
) -> None:
    process = robot("cyan1", *_WAITS)
    launched = fork_server.launch(process, tmp_path / "cyan1.log")
    wait_for(lambda: words_of(launched.pid) == list(process.command))
    group, session = Path(f"/proc/{launched.pid}/stat").read_text().rpartition(")")[2].split()[2:4]
    assert (int(group), int(session)) == (launched.pid, os.getsid(0))
    assert launched.status() is None
    launched.send(signal.SIGTERM)
    assert end_of(launched) in _ENDED


def test_a_robot_that_is_killed_can_be_launched_again(fork_server: ForkServer, tmp_path: Path) -> None:
    launched = fork_server.launch(robot("cyan1", *_WAITS), tmp_path / "cyan1.log")
    launched.send(signal.SIGKILL)
    assert end_of(launched) == -signal.SIGKILL
    again = fork_server.launch(robot("cyan1", "--no-such-word"), tmp_path / "cyan1.log")
    assert isinstance(again, ForkedProcess)
    assert end_of(again) == 2


def test_robots_live_on_without_their_fork_server(fork_server: ForkServer, tmp_path: Path) -> None:
    launched = fork_server.launch(robot("cyan1", *_WAITS), tmp_path / "cyan1.log")
    fork_server.close()
    assert launched.status() is None
    launched.send(signal.SIGTERM)
    assert end_of(launched) in _ENDED
    assert not (tmp_path / "fork_server.log").exists()


def test_sets_of_words_have_the_same_order_in_every_robot(fork_server: ForkServer, tmp_path: Path) -> None:
    """The seed of Python's hashes is taken when an interpreter begins, so the fork server's own has to have it."""
    assert PROCESSES[ProcessKind.AGENT].environment["PYTHONHASHSEED"] == "0"
    launched = fork_server.launch(robot("cyan1", *_WAITS), tmp_path / "cyan1.log")
    environment = Path(f"/proc/{launched.pid}/environ").read_bytes().split(b"\0")
    assert b"PYTHONHASHSEED=0" in environment


def test_a_robot_whose_end_nobody_noted_has_ended(tmp_path: Path) -> None:
    """As where SIGCHLD is ignored, which a process inherits."""
    program = subprocess.Popen(["true"])
    program.wait()
    assert ForkedProcess(robot("cyan1"), tmp_path / "cyan1.log", 0, program.pid).status() == 0


def test_other_programs_are_launched_by_their_command_lines(fork_server: ForkServer, tmp_path: Path) -> None:
    process = Process("cyan1", ProcessKind.AGENT, (sys.executable, "-c", "print('plain')"), {})
    launched = fork_server.launch(process, tmp_path / "cyan1.log")
    assert isinstance(launched, ChildProcess)
    assert end_of(launched) == 0
    assert launched.last_lines() == ["plain"]


def test_robots_are_launched_by_their_command_lines_when_the_nursery_is_gone(
    fork_server: ForkServer, tmp_path: Path
) -> None:
    first = fork_server.launch(robot("cyan1", "--help"), tmp_path / "cyan1.log")
    assert end_of(first) == 0
    keeper = next(
        int(folder.name)
        for folder in Path("/proc").glob("[0-9]*")
        if "robot_agent.fork_server" in words_of(int(folder.name))
        and str(tmp_path / "fork_server.log") == str((folder / "fd" / "2").readlink())
    )
    subprocess.run(["kill", "-9", str(keeper)], check=True)
    wait_for(lambda: not is_running(keeper))
    second = fork_server.launch(robot("cyan2", "--no-such-word"), tmp_path / "cyan2.log")
    assert isinstance(second, ChildProcess)
    assert end_of(second) == 2


def test_a_robot_dies_with_a_supervisor_that_was_killed(tmp_path: Path) -> None:
    code = f"""
import os, signal, sys
from pathlib import Path
from touchline.launch.fork_server import ForkServer
from touchline.launch.processes import ProcessKind, Process
folder = Path({str(tmp_path)!r})
command = (sys.executable, "-m", "robot_agent", "--robot", "cyan1", *{_WAITS!r})
fork_server = ForkServer(folder / "fork_server.log")
robot = fork_server.launch(Process("cyan1", ProcessKind.AGENT, command, {{}}), folder / "cyan1.log")
while b"--robot" not in Path(f"/proc/{{robot.pid}}/cmdline").read_bytes().split(b"\\0"):
    pass
print(robot.pid)
sys.stdout.flush()
os.kill(os.getpid(), signal.SIGKILL)
"""
    supervisor = ChildProcess(
        Process("supervisor", ProcessKind.HOST, (sys.executable, "-c", code), {}), tmp_path / "supervisor.log"
    )
    assert end_of(supervisor) == -signal.SIGKILL
    orphan = int(supervisor.last_lines()[0])
    wait_for(lambda: not is_running(orphan))


def test_what_robots_are_forked_from_runs_no_threads_and_knows_no_numbers_that_they_would_share() -> None:
    code = "import sys, threading, robot_agent.fork_server; print(threading.active_count(), 'numpy' in sys.modules)"
    printed = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, check=True, text=True).stdout
    assert printed.split() == ["1", "False"]
