"""Robots that are forked by the fork server, against those that are launched by their command lines: they act alike."""

import operator
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from robot_agent.forked import PRELOAD
from robot_agent.settings import AgentSettings
from schemas.bus.endpoint import with_free_port
from schemas.bus.zenoh.bus import open_host
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.rule_book import load_rule_book
from schemas.config.settings_file import read_settings
from schemas.messages.setup import Setup
from schemas.process.clock import WallClock
from schemas.topics import SETUP
from touchline.launch.child_process import ChildProcess, ProcessHandle
from touchline.launch.fork_server import ForkedRobot, ForkServer
from touchline.launch.process_table import Process, ProcessKind
from touchline.launch.processes import MatchPlan, client_processes
from touchline.matches.engine.child_processes import run_in_processes

pytestmark = [
    pytest.mark.processes,
    pytest.mark.skipif(sys.platform != "linux", reason="robots are forked on Linux alone"),
]
_LIMIT_S = 120.0
_NOBODY = "tcp/127.0.0.1:1"
"""An endpoint at which no host will ever answer."""
_ENDED = (0, -signal.SIGTERM)
"""How a robot ends after a signal: by itself, or before it handled signals."""


def robot(folder: Path, name: str, patience: float = 600.0, **environment: str) -> Process:
    settings = AgentSettings(connect=_NOBODY, match="test", robot=name, brain="no:Brain", patience=patience)
    file = folder / f"{name}.json"
    command = (sys.executable, "-m", "robot_agent", "--settings", str(file))
    return Process(name, ProcessKind.AGENT, command, {"PYTHONHASHSEED": "0", **environment}, 3, settings, file)


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


def fields_of(pid: int) -> list[str]:
    """The fields of proc(5)'s `stat` behind the name: state, parent, group, session."""
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()


def is_running(pid: int) -> bool:
    """Whether a process exists and is no zombie."""
    try:
        return fields_of(pid)[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def name_of(pid: int) -> str:
    return Path(f"/proc/{pid}/comm").read_text().strip()


@pytest.fixture
def launch(tmp_path: Path) -> Iterator[Callable[[Process], ProcessHandle]]:
    """Launches processes with a fork server, and ends those that are left."""
    server, launched = ForkServer(), []

    def launch(process: Process) -> ProcessHandle:
        launched.append(server.launch(process, tmp_path / f"{process.name}.log"))
        return launched[-1]

    yield launch
    for one in launched:
        one.send(signal.SIGKILL)
        end_of(one)


def test_a_robot_has_its_own_log_and_exit_status(launch: Callable[[Process], ProcessHandle], tmp_path: Path) -> None:
    (tmp_path / "cyan1.log").write_text("earlier\n")
    launched = launch(robot(tmp_path, "cyan1", patience=0.0))
    assert isinstance(launched, ForkedRobot)
    assert end_of(launched) == 2
    (line,) = launched.last_lines()
    assert line.startswith(f"touchline: --connect {_NOBODY}: no host answers there")
    assert (tmp_path / "cyan1.log").read_text().startswith("earlier\n")


def test_a_robot_leads_its_own_group_in_the_session_of_its_supervisor_and_has_a_name(
    launch: Callable[[Process], ProcessHandle], tmp_path: Path
) -> None:
    launched = launch(robot(tmp_path, "magenta1"))
    wait_for(lambda: name_of(launched.pid) == "magenta1")
    assert str(Path(f"/proc/{launched.pid}/fd/0").readlink()) == os.devnull
    group, session = fields_of(launched.pid)[2:4]
    assert (int(group), int(session)) == (launched.pid, os.getsid(0))
    assert launched.status() is None
    launched.send(signal.SIGTERM)
    assert end_of(launched) in _ENDED


def test_a_robot_that_is_signalled_at_once_is_reached(
    launch: Callable[[Process], ProcessHandle], tmp_path: Path
) -> None:
    """Before it leads its group, too."""
    launched = launch(robot(tmp_path, "cyan1"))
    launched.send(signal.SIGKILL)
    assert end_of(launched) == -signal.SIGKILL


def test_a_robot_that_is_launched_again_is_launched_by_its_command_line(
    launch: Callable[[Process], ProcessHandle], tmp_path: Path
) -> None:
    first = launch(robot(tmp_path, "cyan1", patience=0.0))
    assert isinstance(first, ForkedRobot)
    assert end_of(first) == 2
    said = first.last_lines()
    again = launch(robot(tmp_path, "cyan1", patience=0.0))
    assert isinstance(again, ChildProcess)
    assert end_of(again) == 2
    assert again.last_lines() == said


def test_the_settings_of_a_forked_robot_stand_in_their_file_too(
    launch: Callable[[Process], ProcessHandle], tmp_path: Path
) -> None:
    process = robot(tmp_path, "cyan1", patience=0.0)
    end_of(launch(process))
    assert read_settings(AgentSettings, str(process.settings_file)) == process.settings


BRAIN = """
import os, sys, threading

class Brain:
    def __init__(self, briefing):
        words = list({"one", "two", "three", "four", "five"})
        print(os.environ["TOUCHLINE_SIDE"], os.environ["OMP_NUM_THREADS"], sys.flags.hash_randomization, *words)
        print("numpy" in sys.modules, sys.path[-1], os.getcwd(), "PYTHONSAFEPATH" in os.environ)
        sys.stdout.flush()
        os._exit(7)

    def act(self, sight):
        pass
"""


@pytest.fixture
def cyan1(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[Process, Callable[[], None]]]:
    """A robot whose brain prints what it was started with, and a function by which its host answers it once."""
    (tmp_path / "mind.py").write_text(BRAIN)
    monkeypatch.chdir(tmp_path)
    endpoint = with_free_port("tcp/127.0.0.1:0")
    plan = MatchPlan(load_match(None, {"teams.cyan.brain": "mind:Brain"}), endpoint, tmp_path, None)
    with open_host("friendly", WallClock(), endpoint) as host:
        server = host.serve(SETUP)

        def answer() -> None:
            query = server.receive(_LIMIT_S)
            assert query is not None
            query.reply(Setup.of(load_match(None), load_profile("msl"), load_rule_book("friendly")))

        yield client_processes(plan)[0], answer


def test_forked_or_not_a_robot_has_the_same_environment_module_path_and_order_of_sets(
    launch: Callable[[Process], ProcessHandle], cyan1: tuple[Process, Callable[[], None]], tmp_path: Path
) -> None:
    """The seed of Python's hashes is taken when an interpreter begins, so the fork server's own has to have it."""
    process, answer = cyan1
    said = []
    for kind in (ForkedRobot, ChildProcess):
        launched = launch(process)
        assert isinstance(launched, kind)
        answer()
        assert end_of(launched) == 7, launched.last_lines()
        said.append(launched.last_lines())
    assert said[0] == said[1]
    assert said[0][0].startswith("cyan 1 0 ")
    assert said[0][1] == f"False {tmp_path} {tmp_path / 'cyan1'} False"


def test_robots_have_a_fork_server_of_their_own_after_a_series_in_the_same_process(
    launch: Callable[[Process], ProcessHandle], cyan1: tuple[Process, Callable[[], None]]
) -> None:
    """That of `multiprocessing` has the environment and the modules of whatever started it first."""
    ((_, result),) = run_in_processes(operator.is_, [1], jobs=1)
    assert result is False
    process, answer = cyan1
    launched = launch(process)
    assert isinstance(launched, ForkedRobot)
    answer()
    assert end_of(launched) == 7
    first, second = launched.last_lines()
    assert first.startswith("cyan 1 0 ")
    assert second.startswith("False ")


def test_other_programs_are_launched_by_their_command_lines(
    launch: Callable[[Process], ProcessHandle], tmp_path: Path
) -> None:
    launched = launch(Process("cyan1", ProcessKind.AGENT, (sys.executable, "-c", "print('plain')"), {}))
    assert isinstance(launched, ChildProcess)
    assert end_of(launched) == 0
    assert launched.last_lines() == ["plain"]


SUPERVISOR = """
import os, signal, sys
from pathlib import Path
from touchline.launch.fork_server import ForkServer
from touchline.launch.process_table import ProcessKind, Process
from touchline.launch.processes import MatchPlan, client_processes
from robot_agent.settings import AgentSettings
folder, server = Path(sys.argv[1]), ForkServer()
for name in sys.argv[2:]:
    settings = AgentSettings(connect="tcp/127.0.0.1:1", robot=name, brain="no:Brain", patience=600)
    process = Process(name, ProcessKind.AGENT, ("none",), {"PYTHONHASHSEED": "0"}, 3, settings, folder / f"{name}.json")
    robot = server.launch(process, folder / f"{name}.log")
    while Path(f"/proc/{robot.pid}/comm").read_text().strip() != name:
        pass
    print(robot.pid, flush=True)
signal.pause()
"""


def test_robots_and_their_fork_server_end_with_a_supervisor_that_is_killed(tmp_path: Path) -> None:
    """A robot that stands still, too, whose own code could not end it."""
    command = (sys.executable, "-c", SUPERVISOR, str(tmp_path), "cyan1", "cyan2")
    supervisor = ChildProcess(Process("supervisor", ProcessKind.HOST, command, {}), tmp_path / "supervisor.log")
    wait_for(lambda: len(supervisor.last_lines()) == 2 or supervisor.status() is not None)
    robots = [int(line) for line in supervisor.last_lines()]
    servers = {int(fields_of(pid)[1]) for pid in robots}
    assert len(servers) == 1
    os.kill(robots[0], signal.SIGSTOP)
    os.kill(supervisor.pid, signal.SIGKILL)
    assert end_of(supervisor) == -signal.SIGKILL
    wait_for(lambda: not any(is_running(pid) for pid in (*robots, *servers)))


def test_robots_whose_fork_server_is_killed_count_as_crashed_and_are_ended(
    launch: Callable[[Process], ProcessHandle], tmp_path: Path
) -> None:
    """No other process can report how they end."""
    first = launch(robot(tmp_path, "cyan1"))
    os.kill(int(fields_of(first.pid)[1]), signal.SIGKILL)
    assert end_of(first) == 255
    wait_for(lambda: not is_running(first.pid))
    assert isinstance(launch(robot(tmp_path, "cyan2")), ForkedRobot)


def test_what_robots_are_forked_from_runs_no_threads_and_knows_no_numbers_that_they_would_share() -> None:
    code = f"import sys, threading, {', '.join(PRELOAD)}; print(threading.active_count(), 'numpy' in sys.modules)"
    printed = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, check=True, text=True).stdout
    assert printed.split() == ["1", "False"]


def test_the_fork_server_s_own_function_is_imported_without_anything_heavy() -> None:
    code = "import sys, touchline.launch.fork_server; print(*{'zenoh', 'pybullet', 'mcap', 'numpy'} & set(sys.modules))"
    printed = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, check=True, text=True).stdout
    assert printed.split() == []


UNDER_NOHUP = """
import signal, sys, time
from pathlib import Path
from robot_agent.settings import AgentSettings
from touchline.launch.child_process import ChildProcess
from touchline.launch.fork_server import ForkServer
from touchline.launch.process_table import Process, ProcessKind
for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
folder = Path(sys.argv[1])
settings = AgentSettings(connect="tcp/127.0.0.1:1", match="m", robot="cyan1", brain="no:Brain", patience=600)
robot = Process("cyan1", ProcessKind.AGENT, ("none",), {}, 3, settings, folder / "cyan1.json")
code = "import signal; print('rests', flush=True); signal.pause()"
host = Process("host", ProcessKind.HOST, (sys.executable, "-c", code), {})
for number in (signal.SIGINT, signal.SIGTERM):
    forked, program = ForkServer().launch(robot, folder / "cyan1.log"), ChildProcess(host, folder / "host.log")
    while Path(f"/proc/{forked.pid}/comm").read_text().strip() != "cyan1" or not program.last_lines():
        time.sleep(0.01)
    for child in (forked, program):
        child.send(signal.SIGHUP)
        assert child.status() is None
        child.send(number)
        while child.status() is None:
            time.sleep(0.01)
        print(number.name, type(child).__name__)
"""


def test_processes_are_ended_by_signals_that_their_launcher_ignores(tmp_path: Path) -> None:
    """Shells start background jobs with SIGINT ignored; what `nohup` ignores, SIGHUP, stays ignored."""
    command = [sys.executable, "-c", UNDER_NOHUP, str(tmp_path)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=_LIMIT_S, check=False)
    assert ended.stdout.splitlines() == [
        f"{number} {kind}" for number in ("SIGINT", "SIGTERM") for kind in ("ForkedRobot", "ChildProcess")
    ], ended.stderr
