"""Matches of real processes on loopback: started, watched, harmed and ended."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from schemas.bus.contract import Subscription
from schemas.bus.endpoint import with_free_port
from schemas.bus.zenoh.bus import ZenohBus, open_client
from schemas.config.settings import Settings
from schemas.messages.host import Applied, Health, Invalid, RobotHealth
from schemas.messages.world import World
from schemas.process.clock import WallClock
from schemas.process.settings_file import write_settings
from schemas.topics import APPLIED, EVENT, HEALTH, INVALID, STATE, WORLD

LIMIT = 90.0
"""Seconds after which something that should have happened will not; nothing depends on how soon it does."""
POLL = 0.01
NO_PYBULLET = """
from importlib.machinery import PathFinder
find = PathFinder.find_spec
PathFinder.find_spec = lambda name, *more: None if name == "pybullet" else find(name, *more)
"""
"""As `sitecustomize`, makes PyBullet a module that is not installed."""


def wait_for(condition: Callable[[], Any], what: str) -> Any:
    """What the condition gives as soon as it gives something."""
    deadline = time.monotonic() + LIMIT
    while time.monotonic() < deadline:
        found = condition()
        if found:
            return found
        time.sleep(POLL)
    raise AssertionError(f"never came: {what}")


def is_running(pid: int) -> bool:
    """Whether a process is there and not a mere entry that nobody has looked at."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except FileNotFoundError:
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


def descendants(pid: int) -> list[int]:
    """The processes that a process started, and those that they started."""
    parents: dict[int, int] = {}
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):  # it ended meanwhile
            parents[int(folder.name)] = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
    found = [pid]
    for one in found:
        found += [child for child, parent in parents.items() if parent == one]
    return found[1:]


def process_name(pid: int) -> str | None:
    """What a process of a match is called, by its settings file or, where it was forked, by its name in `ps`."""
    try:
        words = Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
        name = Path(f"/proc/{pid}/comm").read_text().strip()
    except OSError:
        return None  # it ended meanwhile
    if "--settings" in words:
        return Path(words[words.index("--settings") + 1]).stem
    is_forked = any("multiprocessing.forkserver" in word for word in words)
    return name if is_forked and name != Path(sys.executable).name else None


class Program:
    """A Python program with its words in files."""

    def __init__(self, arguments: list[str], folder: Path, name: str, environment: dict[str, str]) -> None:
        self.folder = folder
        self._out, self._err = folder / f"{name}.out", folder / f"{name}.err"
        with self._out.open("wb") as out, self._err.open("wb") as err:
            self.popen = subprocess.Popen(
                [sys.executable, "-m", *arguments],
                cwd=folder,
                env={**os.environ, **environment},
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=err,
            )

    @property
    def out(self) -> str:
        return self._out.read_text()

    @property
    def err(self) -> str:
        return self._err.read_text()

    def status(self) -> int:
        """Its exit status, once it has ended."""
        return self.popen.wait(LIMIT)

    def says(self, words: str) -> None:
        """Wait until these words stand on its stderr."""
        wait_for(lambda: words in self.err, f"{words!r} in: {self.err}")

    def processes(self) -> dict[str, int]:
        """Name → pid of the processes of its match that run; the fork server and its like are not among them."""
        names = {pid: process_name(pid) for pid in descendants(self.popen.pid)}
        return {name: pid for pid, name in names.items() if name is not None}

    def process(self, name: str) -> int:
        """The pid of one process of its match: host, recorder, page, or a robot."""
        pid: int = wait_for(lambda: self.processes().get(name), f"a process {name}; stderr: {self.err}")
        return pid

    def end(self) -> None:
        if self.popen.poll() is None:
            left = descendants(self.popen.pid)
            self.popen.kill()
            self.popen.wait()
            for pid in left:
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    continue


class Listener:
    """A client that keeps what a host says."""

    def __init__(self, match: str, endpoint: str, program: Program) -> None:
        self._program = program
        self.bus: ZenohBus = open_client(match, WallClock(), endpoint, LIMIT)
        self._subscriptions: dict[str, Subscription] = {
            topic.key: self.bus.subscribe(topic) for topic in (WORLD, APPLIED, HEALTH, EVENT, INVALID, STATE)
        }
        self.said: dict[str, list[Any]] = {key: [] for key in self._subscriptions}

    def update(self) -> None:
        for key, subscription in self._subscriptions.items():
            self.said[key].extend(received.message() for received in iter(subscription.receive, None))

    def until(self, condition: Callable[["Listener"], Any], what: str) -> Any:
        """Listen until the condition holds; what it gave."""

        def heard() -> Any:
            self.update()
            return condition(self)

        try:
            return wait_for(heard, what)
        except AssertionError as error:
            newest = f"tick {self.tick}, connected {self.bus.connected()}, health {self.healths[-1:]}"
            program = f"status {self._program.popen.poll()}, stderr: {self._program.err}"
            raise AssertionError(f"{error}\n{newest}\n{program}") from None

    def until_tick(self, tick: int) -> None:
        self.until(lambda one: one.tick >= tick, f"tick {tick}")

    def for_ticks(self, count: int) -> None:
        self.update()
        self.until_tick(self.tick + count)

    @property
    def worlds(self) -> list[World]:
        return self.said["world"]

    @property
    def applied(self) -> list[Applied]:
        return self.said["host/applied"]

    @property
    def healths(self) -> list[Health]:
        return self.said["host/health"]

    @property
    def invalid(self) -> list[Invalid]:
        return self.said["host/invalid"]

    @property
    def tick(self) -> int:
        """The newest tick heard of."""
        return self.worlds[-1].tick if self.worlds else -1

    def robot(self, name: str) -> RobotHealth:
        """What the host says last of one robot's agent."""
        return self.healths[-1].robots[name] if self.healths else RobotHealth()


@pytest.fixture(scope="module")
def start(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., Program]]:
    """Starts Python programs, each in its folder, and ends those that are left."""
    running: list[Program] = []

    def start(
        *arguments: str, folder: Path, name: str = "touchline", settings: Settings | None = None, **environment: str
    ) -> Program:
        if settings is not None:
            write_settings(settings, folder / f"{name}.json")
            arguments = (*arguments, "--settings", f"{name}.json")
        running.append(Program(list(arguments), folder, name, environment))
        return running[-1]

    yield start
    for program in running:
        program.end()


@pytest.fixture(scope="module")
def listen() -> Iterator[Callable[[str, str, Program], Listener]]:
    """Opens clients of a program's match, as soon as its host is there."""
    open_ones: list[Listener] = []

    def listen(match: str, endpoint: str, program: Program) -> Listener:
        open_ones.append(Listener(match, endpoint, program))
        return open_ones[-1]

    yield listen
    for listener in open_ones:
        listener.bus.close()


@pytest.fixture(name="is_running")
def is_running_fixture() -> Callable[[int], bool]:
    return is_running


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the programs of a test file run."""
    return tmp_path_factory.mktemp("match")


@pytest.fixture(scope="module")
def endpoint() -> str:
    return with_free_port("tcp/127.0.0.1:0")


@pytest.fixture(scope="module")
def without_pybullet(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The environment of a machine on which PyBullet is not installed."""
    place = tmp_path_factory.mktemp("without_pybullet")
    (place / "sitecustomize.py").write_text(NO_PYBULLET)
    others = os.environ.get("PYTHONPATH")
    return {"PYTHONPATH": os.pathsep.join([str(place), *([others] if others else [])])}
