"""All robots of a team in one process: a thread each, on one session of the bus, whose brains think in turns.

A match needs a session for each process, and most of its CPU time goes to them: five robots in one process cost a third
of five processes. A brain that raises ends the process, and with it its teammates. The threads end before the process:
one that returned from Zenoh into an interpreter that shuts down would abort it.
"""

import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from queue import Empty, SimpleQueue
from typing import NamedTuple

from robot_agent.loading.brain_error import RobotError
from robot_agent.process.brain_runner import report_hang
from robot_agent.process.runner import Runner
from robot_agent.process.timing import HANG_S, PROGRAM_ENDS_S
from robot_agent.sdk.contract import Brain
from runtime.bus.contract import Bus
from runtime.process.clock import Clock
from runtime.process.process_log import Level, log_line
from schemas.messages.sight import Sight

MakeRunner = Callable[[Bus, Brain, str], Runner]


class _Turn(NamedTuple):
    """A robot that answers a sight."""

    thread: int
    sight: Sight


class Turns:
    """Lets the robots of a process answer one at a time, whose brains may share what their modules hold."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._turn: _Turn | None = None
        self._seen: _Turn | None = None

    @contextmanager
    def of(self, sight: Sight) -> Iterator[None]:
        """The turn of the robot of this thread, which waits for that of others."""
        with self._lock:
            self._turn = _Turn(threading.get_ident(), sight)
            try:
                yield
            finally:
                self._turn = None

    def look(self) -> None:
        """Report a robot that has its turn since the last look, once."""
        before, self._seen = self._seen, self._turn
        if before is not None and before is self._seen:
            report_hang(before.sight, sys._current_frames().get(before.thread))
            self._seen = None


class TurnRunner(Runner):
    """Answers each sight of one robot when it is its turn."""

    def __init__(self, turns: Turns, bus: Bus, brain: Brain, robot: str) -> None:
        super().__init__(bus, brain, robot)
        self._turns = turns

    def answer(self, sight: Sight) -> None:
        """Send the brain's command, as in `Runner`."""
        with self._turns.of(sight):
            try:
                super().answer(sight)
            except RobotError:
                log_line(f"{sight.robot} has failed, and with it the process of its team", Level.ERROR)
                raise


def serve_team(
    robots: Sequence[str], serve_robot: Callable[[str, MakeRunner], int], stop: Callable[[], None], clock: Clock
) -> int:
    """Run each robot by `serve_robot(robot, its runner)` in a thread, until one of them ends; returns its status.

    `stop` then ends the others, for which this waits up to `PROGRAM_ENDS_S`: a brain that hangs is left behind.

    Raises:
        TouchlineError: what `serve_robot` raises.
    """
    turns, ended = Turns(), SimpleQueue[int | BaseException]()

    def run(robot: str) -> None:
        try:
            ended.put(serve_robot(robot, partial(TurnRunner, turns)))
        except BaseException as error:  # for the thread that waits
            ended.put(error)

    threads = [threading.Thread(target=run, args=(robot,), name=robot, daemon=True) for robot in robots]
    try:
        for thread in threads:
            thread.start()
        end = _first_end(ended, turns)
    finally:
        stop()
        deadline = clock.now() + PROGRAM_ENDS_S
        for thread in filter(threading.Thread.is_alive, threads):
            thread.join(max(0.0, deadline - clock.now()))
    if isinstance(end, BaseException):
        raise end
    return end


def _first_end(ended: "SimpleQueue[int | BaseException]", turns: Turns) -> int | BaseException:
    """Wait for the first robot that ends; a brain that hangs meanwhile is reported."""
    while True:
        try:
            return ended.get(timeout=HANG_S)
        except Empty:
            turns.look()
