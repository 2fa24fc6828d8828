"""All robots of a team in one process: a thread each, on one session of the bus, whose brains think in turns.

A match needs a session for each process, and most of its CPU time goes to them: five robots in one process cost a third
of five processes. A brain that raises ends the process, and with it its teammates. The threads end before the process:
one that returned from Zenoh into an interpreter that shuts down would abort it.
"""

import threading
from collections.abc import Callable, Sequence
from functools import partial
from queue import SimpleQueue

from robot_agent.loading.brain_error import RobotError
from robot_agent.process.brain_runner import BrainRunner
from robot_agent.process.runner import Runner
from robot_agent.process.timing import PROGRAM_ENDS_S
from robot_agent.sdk.contract import Brain
from runtime.bus.contract import Bus
from runtime.process.clock import Clock
from runtime.process.process_log import Level, log_line
from schemas.messages.sight import Sight

MakeRunner = Callable[[Bus, Brain, str], Runner]


class TurnRunner(BrainRunner):
    """Answers each sight of one robot when it is its turn: brains may share what their modules hold."""

    def __init__(self, turn: threading.Lock, bus: Bus, brain: Brain, robot: str) -> None:
        super().__init__(bus, brain, robot)
        self._turn = turn

    def answer(self, sight: Sight) -> None:
        """Send the brain's command, as in `Runner`."""
        with self._turn:
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
    turn, ended = threading.Lock(), SimpleQueue[int | BaseException]()

    def run(robot: str) -> None:
        try:
            ended.put(serve_robot(robot, partial(TurnRunner, turn)))
        except BaseException as error:  # for the thread that waits
            ended.put(error)

    threads = [threading.Thread(target=run, args=(robot,), name=robot, daemon=True) for robot in robots]
    try:
        for thread in threads:
            thread.start()
        end = ended.get()
    finally:
        stop()
        deadline = clock.now() + PROGRAM_ENDS_S
        for thread in filter(threading.Thread.is_alive, threads):
            thread.join(max(0.0, deadline - clock.now()))
    if isinstance(end, BaseException):
        raise end
    return end
