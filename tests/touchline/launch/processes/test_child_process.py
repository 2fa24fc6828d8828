"""Real processes, forked or started by their command lines: both act alike."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from robot_agent.loading.build_check import BuildCheckSettings
from robot_agent.process.settings import AgentSettings
from runtime.process.clock import WallClock
from schemas.config.confinement import Limits
from schemas.config.match_config import load_match
from schemas.side import Side
from support.isolated_match import needs_bubblewrap
from support.process_story import is_running
from support.stepped_clock import SteppedClock
from touchline.launch.confinement.robot_confinement import Confinement
from touchline.launch.confinement.team_code import system_folders
from touchline.launch.processes.child_process import ChildProcess
from touchline.launch.processes.process_table import Process, ProcessKind
from touchline.launch.processes.python_process import PYTHON

pytestmark = [
    pytest.mark.processes,
    pytest.mark.skipif(sys.platform != "linux", reason="robots are forked and limited on Linux alone"),
]
_LIMIT_S = 120.0
_NOBODY = "tcp/127.0.0.1:1"
"""An endpoint at which no host will ever answer."""
KINDS = ("forked", "by command line")
Launch = Callable[..., ChildProcess]


@pytest.fixture
def launch(tmp_path: Path) -> Iterator[Launch]:
    """Launches processes, and ends those that are left."""
    launched: list[ChildProcess] = []

    def launch(process: Process, kind: str = "forked") -> ChildProcess:
        if kind == "by command line" and process.settings is not None and process.settings_file is not None:
            process.settings_file.write_text(process.settings.model_dump_json())
            process = replace(process, settings=None)
        launched.append(ChildProcess(process, tmp_path))
        return launched[-1]

    yield launch
    for one in launched:
        one.send(signal.SIGKILL)
        end_of(one)


def end_of(launched: ChildProcess) -> int:
    """The exit status, once it has ended."""
    status = launched.wait(_LIMIT_S, WallClock())
    assert status is not None
    return status


def wait_for(true: Callable[[], bool]) -> None:
    clock = WallClock()
    deadline = clock.now() + _LIMIT_S
    while not true():
        assert clock.now() < deadline
        clock.sleep_until(clock.now() + 0.01)


def robot(folder: Path, name: str = "cyan1", patience: float = 600.0) -> Process:
    """A robot that waits for a host."""
    settings = AgentSettings(connect=_NOBODY, match="test", robot=name, brain="no:Brain", patience=patience)
    file = folder / f"{name}.json"
    command = (*PYTHON, "-m", "robot_agent", "--settings", str(file))
    return Process(name, ProcessKind.AGENT, command, {"PYTHONHASHSEED": "0"}, 3, settings, file)


def brain(folder: Path, code: str, **limits: float) -> Process:
    """A robot whose brain runs this code when it is built."""
    (folder / "mind.py").write_text(
        "import os, signal, sys, threading\nclass Brain:\n    def __init__(self, briefing):\n"
        + "".join(f"        {line}\n" for line in code.splitlines())
        + "    def act(self, sight): ...\n"
    )
    file = folder / "build.json"
    config = load_match(None, {"teams.cyan.brain": "mind:Brain", "teams.cyan.size": 1})
    settings = BuildCheckSettings(config=config, side=Side.CYAN, brain_folder=folder)
    command = (*PYTHON, "-m", "robot_agent.loading.build_check", "--settings", str(file))
    confinement = Confinement(Limits().model_copy(update=limits), folder / "cyan1", tasks=100_000)
    environment = {"PYTHONHASHSEED": "0", "TOUCHLINE_SIDE": "cyan"}
    return Process("build", ProcessKind.AGENT, command, environment, 0, settings, file, confinement=confinement)


def python(code: str, name: str = "cyan1", **environment: str) -> Process:
    return Process(name, ProcessKind.AGENT, (sys.executable, "-c", code), environment)


def fields_of(pid: int) -> list[str]:
    """The fields of proc(5)'s `stat` behind the name: state, parent, group, session."""
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()


def name_of(pid: int) -> str:
    return Path(f"/proc/{pid}/comm").read_text().strip()


@pytest.mark.parametrize("kind", KINDS)
def test_a_robot_has_its_own_log_and_exit_status(launch: Launch, tmp_path: Path, kind: str) -> None:
    (tmp_path / "cyan1.log").write_text("earlier\n")
    launched = launch(robot(tmp_path, patience=0.0), kind)
    assert end_of(launched) == 2
    (line,) = launched.last_lines()
    assert line.startswith(f"touchline: --connect {_NOBODY}: no host answers there")
    assert (tmp_path / "cyan1.log").read_text().startswith("earlier\n")


class SleepingClock(SteppedClock):
    """A clock on which nobody waits without sleeping."""

    def sleep_until(self, moment: float) -> None:
        assert moment > self.now()
        super().sleep_until(moment)


def test_who_waits_for_a_robot_sleeps_until_the_time_is_over(launch: Launch) -> None:
    clock = SleepingClock()
    assert launch(python("import time; time.sleep(600)")).wait(0.5, clock) is None
    assert clock.now() == pytest.approx(0.5, abs=0.1)


def test_a_robot_that_runs_as_another_user_is_left_alone(launch: Launch, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: int) -> None:
        raise PermissionError

    launched = launch(python("import time; time.sleep(600)"))
    with monkeypatch.context() as patched:
        patched.setattr(os, "killpg", refuse)
        launched.send(signal.SIGTERM)
        assert launched.status() is None
        launched.send(signal.SIGKILL)
        assert launched.status() == -signal.SIGKILL
    os.killpg(launched.pid, signal.SIGKILL)
    os.waitid(os.P_PID, launched.pid, os.WEXITED | os.WNOWAIT)
    assert launched.status() == -signal.SIGKILL


def test_what_a_terminal_would_obey_is_not_shown(launch: Launch) -> None:
    launched = launch(python(r"print('\x1b]0;owned\x07\x1b[2Jgone')"))
    assert end_of(launched) == 0
    assert launched.last_lines() == ["�]0;owned��[2Jgone"]


def test_of_a_log_in_json_the_messages_are_shown(launch: Launch) -> None:
    line = '{"time": "2026-01-01T00:00:00.000Z", "level": "error", "message": "act failed\\nkick: no"}'
    launched = launch(python(f"print('a print of the brain\\n\\n' {line!r})".replace("' '", "' + '")))
    assert end_of(launched) == 0
    assert launched.last_lines() == ["a print of the brain", "act failed", "kick: no"]
    assert launched.last_lines(1) == ["kick: no"]


def test_a_program_that_does_not_exist_is_reported_in_its_log(launch: Launch) -> None:
    launched = launch(Process("cyan1", ProcessKind.AGENT, ("no-such-program",), {}))
    assert end_of(launched) == 127
    assert launched.last_lines() == ["no-such-program: No such file or directory"]


def test_a_robot_leads_its_own_group_in_the_session_of_its_supervisor_and_has_a_name(
    launch: Launch, tmp_path: Path
) -> None:
    launched = launch(robot(tmp_path, "magenta1"))
    wait_for(lambda: name_of(launched.pid) == "magenta1")
    assert str(Path(f"/proc/{launched.pid}/fd/0").readlink()) == os.devnull
    group, session = fields_of(launched.pid)[2:4]
    assert (int(group), int(session)) == (launched.pid, os.getsid(0))
    assert launched.status() is None
    launched.send(signal.SIGTERM)
    assert end_of(launched) in (0, -signal.SIGTERM)  # by itself, or before it handled signals


def test_a_robot_that_is_signalled_at_once_is_reached(launch: Launch, tmp_path: Path) -> None:
    launched = launch(robot(tmp_path))
    launched.send(signal.SIGKILL)
    assert end_of(launched) == -signal.SIGKILL


def test_what_a_robot_started_ends_with_it(launch: Launch) -> None:
    code = "import subprocess, sys; p = subprocess.Popen(['sleep', '600']); print(p.pid); sys.exit(0)"
    launched = launch(python(code))
    assert end_of(launched) == 0
    grandchild = int(launched.last_lines()[0])
    wait_for(lambda: not is_running(grandchild))


def test_forked_or_not_a_robot_has_the_same_environment_module_path_descriptors_and_order_of_sets(
    launch: Launch, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The seed of Python's hashes is taken when an interpreter begins, so the server's own has to have it."""
    monkeypatch.setenv("AWS_SECRET", "hush")
    code = (
        "print(*{'one', 'two', 'three', 'four', 'five'}, sys.path, os.getcwd(), sys.argv[1:], __name__)\n"
        "print(sorted(os.environ.items()))\n"
        "print(sorted({os.readlink(f'/proc/self/fd/{n}') for n in os.listdir('/proc/self/fd') if int(n) < 3}))\n"
        "print([n for n in os.listdir('/proc/self/fd') if int(n) > 3])\n"
        "print('hush' in open('/proc/self/environ').read(), threading.active_count(), 'numpy' in sys.modules)"
    )
    launch(robot(tmp_path))  # a robot that is forked later has no handle of it
    process = brain(tmp_path, code)
    said = []
    for kind in KINDS:
        launched = launch(process, kind)
        assert end_of(launched) == 0, launched.last_lines()
        said.append(launched.last_lines())
    assert said[0] == said[1]
    assert str(tmp_path / "cyan1") in said[0][0] and "hush" not in said[0][1]
    assert said[0][2:] == [str(sorted([os.devnull, str(tmp_path / "build.log")])), "[]", "False 1 False"]


@pytest.mark.parametrize(
    ("limits", "code", "sentence"),
    [
        (
            {"open_files": 200},
            "self.files = [open('/dev/null') for _ in range(100_000)]",
            "limit reached: it opened more than 200 files at once; raise [limits] open_files",
        ),
        (
            {"memory": 1.5},
            "self.all = bytearray(10_000_000_000)",
            "limit reached: it used more than 1.5 GB of memory; raise [limits] memory",
        ),
        (
            {"file_size": 3.0},
            "with open('much', 'wb') as file:\n    for _ in range(10):\n        file.write(bytes(1_000_000))",
            "limit reached: it wrote more than 3 MB into one file; raise [limits] file_size",
        ),
    ],
)
def test_a_brain_that_exceeds_a_limit_fails_with_the_limit_and_the_remedy(
    launch: Launch, tmp_path: Path, limits: dict[str, float], code: str, sentence: str
) -> None:
    launched = launch(brain(tmp_path, code, **limits))
    assert end_of(launched) == 2
    assert sentence in launched.last_lines(1)[0]


def test_a_robot_whose_cpu_time_is_used_up_is_ended_and_its_breach_named(launch: Launch, tmp_path: Path) -> None:
    launched = launch(brain(tmp_path, "while True: pass", cpu_time=1.0))
    assert end_of(launched) == -signal.SIGXCPU
    assert launched.breach().startswith("it used more than 1 s of CPU time; raise [limits] cpu_time")


@needs_bubblewrap()
@pytest.mark.parametrize(("end", "status"), [("os.kill(os.getpid(), 11)", -signal.SIGSEGV), ("os._exit(255)", 255)])
def test_in_bubblewrap_a_robot_has_the_exit_status_that_it_has_elsewhere(
    launch: Launch, open_folder: Path, end: str, status: int
) -> None:
    confinement = Confinement(Limits(), open_folder / "cyan1", tasks=100_000, visible=tuple(system_folders()))
    process = replace(python(f"import os; {end}"), confinement=confinement)
    assert end_of(launch(process)) == status


def test_an_interrupt_before_the_robot_is_ready_ends_it_without_a_traceback(launch: Launch, tmp_path: Path) -> None:
    launched = launch(brain(tmp_path, "import time\nprint('here', flush=True)\ntime.sleep(600)"))
    wait_for(lambda: launched.last_lines() == ["here"])
    launched.send(signal.SIGINT)
    assert end_of(launched) == 128 + signal.SIGINT
    assert launched.last_lines() == ["here"]


SUPERVISOR = """
import signal, sys
from pathlib import Path
sys.path[:0] = [sys.argv[1], str(Path(sys.argv[1]).parents[2])]
from test_child_process import Process, ProcessKind, ChildProcess, robot, name_of
folder = Path(sys.argv[2])
for name in ("cyan1", "cyan2"):
    forked = ChildProcess(robot(folder, name), folder)
    while name_of(forked.pid) != name:
        pass
    print(forked.pid, flush=True)
print(ChildProcess(Process("host", ProcessKind.HOST, ("sleep", "600"), {}), folder).pid, flush=True)
signal.pause()
"""


def test_all_processes_end_with_a_supervisor_that_is_killed(launch: Launch, tmp_path: Path) -> None:
    """A robot that stands still, too, whose own code could not end it."""
    supervisor = launch(Process("supervisor", ProcessKind.HOST, command_of(SUPERVISOR, tmp_path), {}))
    wait_for(lambda: len(supervisor.last_lines()) == 3 or supervisor.status() is not None)
    first, second, host = (int(line) for line in supervisor.last_lines())
    servers = {int(fields_of(pid)[1]) for pid in (first, second)}
    assert len(servers) == 1
    os.kill(first, signal.SIGSTOP)
    supervisor.send(signal.SIGKILL)
    assert end_of(supervisor) == -signal.SIGKILL
    wait_for(lambda: not any(is_running(pid) for pid in (first, second, host, *servers)))


def command_of(code: str, folder: Path) -> tuple[str, ...]:
    return (sys.executable, "-c", code, str(Path(__file__).parent), str(folder))


def test_robots_whose_server_is_killed_have_been_killed_and_others_get_a_new_one(
    launch: Launch, tmp_path: Path
) -> None:
    first = launch(robot(tmp_path, "cyan1"))
    server = int(fields_of(first.pid)[1])
    os.kill(server, signal.SIGKILL)
    assert end_of(first) == -signal.SIGKILL
    wait_for(lambda: not is_running(first.pid))
    second = launch(robot(tmp_path, "cyan2"))
    assert int(fields_of(second.pid)[1]) not in (server, os.getpid())


def test_what_robots_are_forked_from_runs_no_threads_and_knows_no_numbers_that_they_would_share() -> None:
    code = "import sys, threading, robot_agent.process.forks; print(threading.active_count(), 'numpy' in sys.modules)"
    printed = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, check=True, text=True).stdout
    assert printed.split() == ["1", "False"]


def test_robots_share_the_memory_of_what_they_import_also_after_garbage_was_collected(
    launch: Launch, tmp_path: Path
) -> None:
    """Measured 9.7 of 33 MB of its own; without `gc.freeze` 16.1."""
    code = "import gc\ngc.collect()\nprint(open('/proc/self/smaps_rollup').read())"
    launched = launch(brain(tmp_path, code))
    assert end_of(launched) == 0
    kilobytes = dict(re.findall(r"(\w+): +(\d+) kB", launched.log.read_text()))
    assert int(kilobytes["Private_Dirty"]) < 0.4 * int(kilobytes["Rss"])


UNDER_NOHUP = """
import signal, sys, time
from pathlib import Path
for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
sys.path[:0] = [sys.argv[1], str(Path(sys.argv[1]).parents[2])]
from test_child_process import ChildProcess, name_of, python, robot
folder = Path(sys.argv[2])
code = "import signal; print('rests', flush=True); signal.pause()"
for number in (signal.SIGINT, signal.SIGTERM):
    forked, program = ChildProcess(robot(folder), folder), ChildProcess(python(code, "program"), folder)
    while name_of(forked.pid) != "cyan1" or not program.last_lines():
        time.sleep(0.01)
    for child in (forked, program):
        child.send(signal.SIGHUP)
        assert child.status() is None
        child.send(number)
        while child.status() is None:
            time.sleep(0.01)
        print(number.name)
"""


def test_processes_are_ended_by_signals_that_their_launcher_ignores(tmp_path: Path) -> None:
    """Shells start background jobs with SIGINT ignored; what `nohup` ignores, SIGHUP, stays ignored."""
    command = command_of(UNDER_NOHUP, tmp_path)
    ended = subprocess.run(command, capture_output=True, text=True, timeout=_LIMIT_S, check=False)
    assert re.findall(r"\w+", ended.stdout) == ["SIGINT", "SIGINT", "SIGTERM", "SIGTERM"], ended.stderr
