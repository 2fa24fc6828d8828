"""Programs of a match as real processes on loopback, and a client that listens to their host."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from recordings.reading.recording import RecordedMessage
from runtime.access.accounts import Account
from runtime.bus.contract import ReceivedMessage, Subscription
from runtime.bus.zenoh.bus import ZenohBus, open_client
from runtime.process.clock import WallClock
from schemas.messages.applied import Applied
from schemas.messages.health import Health, RobotHealth
from schemas.messages.soccer.game import GameEvent
from schemas.messages.world import World
from schemas.soccer.game import EventKind
from schemas.topics import APPLIED, EVENT, HEALTH, STATE, WORLD
from schemas.wire.message import BadMessageError

LIMIT = 90.0
"""Patience in s; no test depends on the exact time."""
WHOLE_LIMIT = 240.0
"""The same for a whole match: its five processes take 5 s of a core to start, and 45 s where nine share the core."""
SHORT_LIMIT = 40.0
"""The same where a step takes a few seconds: a failure shows sooner."""
POLL = 0.01


def wait_for(condition: Callable[[], Any], what: str = "", limit: float = LIMIT) -> Any:
    """The first true result of the condition."""
    deadline = time.monotonic() + limit
    while time.monotonic() < deadline:
        found = condition()
        if found:
            return found
        time.sleep(POLL)
    raise AssertionError(f"never came: {what or condition}")


def is_running(pid: int) -> bool:
    """Whether a process is running, and not a zombie."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except FileNotFoundError:
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


def descendants(pid: int) -> list[int]:
    """The processes that a process started, and those that they started."""
    parents: dict[int, int] = {}
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):  # it has ended
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
        return None  # it has ended
    if "--settings" in words:
        return Path(words[words.index("--settings") + 1]).stem
    is_forked = any(word == "robot_agent.process.forks" for word in words)
    return name if is_forked and name != Path(sys.executable).name else None


class Program:
    """A Python program with its output in files."""

    def __init__(
        self, arguments: list[str], folder: Path, name: str, environment: dict[str, str], prefix: Sequence[str] = ()
    ) -> None:
        """`prefix` stands before the command, as that of a network namespace does."""
        self.folder = folder
        self._out, self._err = folder / f"{name}.out", folder / f"{name}.err"
        with self._out.open("wb") as out, self._err.open("wb") as err:
            self.popen = subprocess.Popen(
                [*prefix, sys.executable, "-m", *arguments],
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
        try:
            return self.popen.wait(WHOLE_LIMIT)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"it has not ended: {self.processes()}; {self.err}{self.out}") from None

    def wait_for_error(self, words: str) -> None:
        """Wait until its stderr contains these words."""
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


class MessageLog(Sequence[Any]):
    """Messages of one topic, received or recorded, decoded each time they are read.

    A lockstep match plays thousands of ticks while a test waits for wall time: decoded, they would take ten times the
    memory of their payloads.
    """

    def __init__(
        self, messages: Iterable[ReceivedMessage | RecordedMessage] = (), *, newest_only: bool = False
    ) -> None:
        self._messages = list(messages)
        self._newest = self._messages[-1].message() if self._messages else None
        self._newest_only = newest_only

    def update(self, subscription: Subscription) -> None:
        """Append the received messages.

        The newest one is left out if it is none of this topic: when all processes of a match were suspended, Zenoh has
        passed a message of the old link to the subscription of another key. Programs count such messages as invalid.
        """
        count = len(self._messages)
        self._messages.extend(iter(subscription.receive, None))
        while len(self._messages) > count:
            try:
                self._newest = self._messages[-1].message()
                break
            except BadMessageError:
                del self._messages[-1]
        if self._newest_only:
            del self._messages[:-1]

    def __len__(self) -> int:
        return len(self._messages)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [received.message() for received in self._messages[index]]
        return self._newest if index == -1 and self._messages else self._messages[index].message()


class Listener:
    """A client that keeps the messages that a host publishes."""

    def __init__(
        self, match: str, endpoint: str, program: Program, *, every_tick: bool = True, limit: float = LIMIT
    ) -> None:
        """Without `every_tick`, only the newest world and the newest inputs are kept; `limit` is its patience in s."""
        self._program = program
        self._limit = limit
        self.bus: ZenohBus = open_client(match, WallClock(), endpoint, limit, account=Account.VIEWER)
        self._subscriptions: dict[str, Subscription] = {
            topic.key: self.bus.subscribe(topic) for topic in (WORLD, APPLIED, HEALTH, EVENT, STATE)
        }
        each_tick = (WORLD.key, APPLIED.key)
        self.logs = {key: MessageLog(newest_only=key in each_tick and not every_tick) for key in self._subscriptions}

    def update(self) -> None:
        for key, subscription in self._subscriptions.items():
            self.logs[key].update(subscription)

    def until(self, condition: Callable[["Listener"], Any], what: str) -> Any:
        """Receive until the condition is true; returns its result."""

        def updated() -> Any:
            self.update()
            return condition(self)

        try:
            return wait_for(updated, what, self._limit)
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
    def worlds(self) -> Sequence[World]:
        return self.logs["world"]

    @property
    def applied(self) -> Sequence[Applied]:
        return self.logs["host/applied"]

    @property
    def healths(self) -> Sequence[Health]:
        return self.logs["host/health"]

    @property
    def events(self) -> Sequence[GameEvent]:
        return self.logs["game/event"]

    @property
    def tick(self) -> int:
        """The newest received tick."""
        return self.worlds[-1].tick if self.worlds else -1

    def robot(self, name: str) -> RobotHealth:
        """The newest health of one robot's agent."""
        return self.healths[-1].robots[name] if self.healths else RobotHealth()

    def silences(self, robot: str) -> int:
        """The number of times that the host reported a robot as silent; its health may miss a short silence."""
        return sum(
            event.kind is EventKind.AGENT and event.robot == robot and "does not answer" in event.text
            for event in self.events
        )
