import signal
import sys
from pathlib import Path

import pytest

from schemas.process.clock import SteppedClock, WallClock
from touchline.launch.child_process import ChildProcess
from touchline.launch.processes import Process, ProcessKind
from touchline.launch.supervisor import AFTER_THE_MATCH, AT_ONCE, Supervisor


class Actor:
    """A process that plays its part: runs until it is signalled, or ends with a status when the test sets one."""

    def __init__(self, name: str, clock: SteppedClock, deaf_to: frozenset[signal.Signals] = frozenset()) -> None:
        self.name = name
        self.ended: int | None = None
        self.heard: list[tuple[float, signal.Signals]] = []
        self._clock = clock
        self._deaf_to = deaf_to

    def status(self) -> int | None:
        return self.ended

    def send(self, number: signal.Signals) -> None:
        self.heard.append((round(self._clock.now(), 2), number))
        if number not in self._deaf_to and self.ended is None:
            self.ended = -number

    def last_lines(self, count: int = 5) -> list[str]:
        return [f"last word of {self.name}"]


class Stage:
    """A supervisor over actors; `cast` holds each name's launches, the newest last."""

    def __init__(self, deaf_to: frozenset[signal.Signals] = frozenset()) -> None:
        self.clock = SteppedClock()
        self.deaf_to = deaf_to
        self.cast: dict[str, list[Actor]] = {}
        kinds = {
            "host": ProcessKind.HOST,
            "recorder": ProcessKind.RECORDER,
            "cyan1": ProcessKind.AGENT,
            "magenta1": ProcessKind.AGENT,
        }
        processes = [
            Process(name, kind, ("program",), {}, restarts=3 if kind is ProcessKind.AGENT else 0)
            for name, kind in kinds.items()
        ]
        self.supervisor = Supervisor(processes, self.launch, self.clock)
        self.supervisor.start()

    def launch(self, process: Process) -> Actor:
        actor = Actor(process.name, self.clock, self.deaf_to)
        self.cast.setdefault(process.name, []).append(actor)
        return actor

    def end(self, name: str, status: int) -> None:
        self.cast[name][-1].ended = status


def test_processes_are_launched_in_the_order_of_the_table() -> None:
    assert list(Stage().cast) == ["host", "recorder", "cyan1", "magenta1"]


def test_a_crashed_agent_is_reported_with_its_last_words_and_launched_again() -> None:
    stage = Stage()
    stage.end("cyan1", 1)
    (notice,) = stage.supervisor.check()
    assert notice.sentence == "cyan1 ended with status 1; started again (1 of 3)"
    assert notice.log == ("last word of cyan1",)
    assert len(stage.cast["cyan1"]) == 2
    assert stage.supervisor.check() == []
    assert "cyan1" not in stage.supervisor.ended


def test_an_agent_that_keeps_crashing_is_launched_again_three_times_and_then_left() -> None:
    stage = Stage()
    sentences = []
    for _ in range(6):
        stage.end("cyan1", -signal.SIGSEGV)
        sentences += [notice.sentence for notice in stage.supervisor.check()]
    assert len(stage.cast["cyan1"]) == 4
    assert sentences[-1] == "cyan1 was ended by SIGSEGV; not started again"
    assert len(sentences) == 4
    assert len(stage.cast["magenta1"]) == 1
    assert stage.supervisor.host_status is None


def test_an_agent_that_leaves_with_status_0_is_not_launched_again() -> None:
    stage = Stage()
    stage.end("cyan1", 0)
    assert stage.supervisor.check() == []
    assert len(stage.cast["cyan1"]) == 1
    assert stage.supervisor.ended == {"cyan1": 0}


def test_a_crashed_recorder_is_reported_and_not_launched_again() -> None:
    stage = Stage()
    stage.end("recorder", 1)
    assert [notice.sentence for notice in stage.supervisor.check()] == [
        "recorder ended with status 1; not started again"
    ]
    assert len(stage.cast["recorder"]) == 1


def test_no_process_is_restarted_for_a_host_that_is_gone() -> None:
    stage = Stage()
    stage.end("cyan1", 1)
    stage.end("host", 3)
    assert stage.supervisor.check() == []
    assert stage.supervisor.host_status == 3
    assert len(stage.cast["cyan1"]) == 1


def test_at_once_the_host_hears_first_and_the_recorder_last() -> None:
    stage = Stage()
    stage.supervisor.end(AT_ONCE)
    first = {name: actors[-1].heard[0] for name, actors in stage.cast.items()}
    assert first["host"] == (0.0, signal.SIGTERM)
    assert first["host"][0] < first["cyan1"][0] == first["magenta1"][0] < first["recorder"][0]
    assert set(stage.supervisor.ended) == set(stage.cast)


def test_whoever_does_not_listen_is_killed_within_two_seconds() -> None:
    stage = Stage(deaf_to=frozenset({signal.SIGTERM}))
    stage.supervisor.end(AT_ONCE)
    assert stage.supervisor.ended == dict.fromkeys(stage.cast, -signal.SIGKILL)
    assert stage.clock.now() < 2.0


def test_after_the_match_a_recorder_has_time_to_finish_while_agents_are_sent_away() -> None:
    stage = Stage(deaf_to=frozenset({signal.SIGTERM}))
    stage.end("host", 0)
    stage.supervisor.end(AFTER_THE_MATCH, should_abort=lambda: stage.clock.now() > 20.0)
    assert stage.cast["recorder"][-1].heard == []
    assert stage.supervisor.ended["cyan1"] == -signal.SIGKILL


def test_a_process_that_has_ended_gets_no_signal() -> None:
    stage = Stage()
    for name in stage.cast:
        stage.end(name, 0)
    stage.supervisor.end(AFTER_THE_MATCH)
    assert all(actors[-1].heard == [] for actors in stage.cast.values())


def test_a_second_interrupt_does_not_wait_for_the_recorder() -> None:
    stage = Stage()
    stage.end("host", 0)
    stage.supervisor.end(AFTER_THE_MATCH, should_abort=lambda: stage.clock.now() > 3.0)
    assert stage.clock.now() < 4.0
    assert "recorder" not in stage.supervisor.ended
    stage.supervisor.end(AT_ONCE)
    assert stage.supervisor.ended["recorder"] == -signal.SIGTERM


def python(code: str, name: str = "cyan1", **environment: str) -> Process:
    return Process(name, ProcessKind.AGENT, (sys.executable, "-c", code), environment)


def wait_for(child: ChildProcess) -> int:
    clock = WallClock()
    while (status := child.status()) is None:
        clock.sleep_until(clock.now() + 0.01)
    return status


@pytest.mark.processes
def test_a_child_has_its_own_environment_log_and_exit_status(tmp_path: Path) -> None:
    code = "import os, sys; print(os.environ['TOUCHLINE_ROBOT']); sys.exit('brain raised')"
    child = ChildProcess(python(code, TOUCHLINE_ROBOT="cyan1", PYTHONUNBUFFERED="1"), tmp_path / "cyan1.log")
    assert wait_for(child) == 1
    assert child.last_lines() == ["cyan1", "brain raised"]
    assert child.last_lines(1) == ["brain raised"]


@pytest.mark.processes
def test_a_program_that_does_not_exist_is_reported_in_its_log(tmp_path: Path) -> None:
    child = ChildProcess(Process("cyan1", ProcessKind.AGENT, ("no-such-program",), {}), tmp_path / "cyan1.log")
    assert wait_for(child) == 127
    assert child.last_lines() == ["no-such-program: No such file or directory"]


@pytest.mark.processes
def test_what_a_child_started_ends_with_it(tmp_path: Path) -> None:
    code = "import subprocess, sys; p = subprocess.Popen(['sleep', '600']); print(p.pid); sys.exit(0)"
    child = ChildProcess(python(code), tmp_path / "cyan1.log")
    assert wait_for(child) == 0
    grandchild = int(child.last_lines()[0])
    clock = WallClock()
    while is_running(grandchild):
        clock.sleep_until(clock.now() + 0.01)


@pytest.mark.processes
@pytest.mark.skipif(sys.platform != "linux", reason="the leash is a means of the Linux kernel")
def test_a_child_dies_with_a_supervisor_that_was_killed(tmp_path: Path) -> None:
    code = f"""
import os, signal, sys
from pathlib import Path
from touchline.launch.child_process import ChildProcess
from touchline.launch.processes import ProcessKind, Process
child = ChildProcess(Process("cyan1", ProcessKind.AGENT, ("sleep", "600"), {{}}), Path({str(tmp_path / "sleep.log")!r}))
while b"sleep" not in Path(f"/proc/{{child.pid}}/cmdline").read_bytes().split(b"\\0")[:1]:
    pass
print(child.pid)
sys.stdout.flush()
os.kill(os.getpid(), signal.SIGKILL)
"""
    supervisor = ChildProcess(python(code), tmp_path / "supervisor.log")
    assert wait_for(supervisor) == -signal.SIGKILL
    orphan = int(supervisor.last_lines()[0])
    clock = WallClock()
    while is_running(orphan):
        clock.sleep_until(clock.now() + 0.01)


def is_running(pid: int) -> bool:
    """Whether a process exists and is no zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False
