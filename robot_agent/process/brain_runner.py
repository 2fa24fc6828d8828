"""Runs a brain in its own process, whose log gets the stack where the brain does not return."""

import signal
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from types import FrameType

from robot_agent.loading.user_code import is_users, shown_path
from robot_agent.process.runner import Runner
from robot_agent.process.timing import HANG_S
from runtime.process.process_log import Level, log_line, log_note
from schemas.messages.sight import Sight


class BrainRunner(Runner):
    """Answers each sight by a brain; the brain is not interrupted."""

    def _think(self, sight: Sight) -> bytes:
        with _hang_alarm(HANG_S, partial(report_hang, sight)):
            return super()._think(sight)


def report_hang(sight: Sight, frame: FrameType | None) -> None:
    """Log the stack of a brain that has not answered a sight for `HANG_S`, of the innermost `frame`, and note it."""
    stack = [one for one in traceback.extract_stack(frame) if is_users(one.filename)]
    if stack:
        log_line("".join(traceback.format_list(stack)), Level.WARNING, tick=sight.tick)
        log_note(
            f"act has not returned for {HANG_S:g} s in {shown_path(stack[-1].filename)}",
            f"{sight.robot} is in line {stack[-1].lineno} at tick {sight.tick}; its log has the stack",
        )


@contextmanager
def _hang_alarm(seconds: float, overdue: Callable[[FrameType | None], None]) -> Iterator[None]:
    """Call `overdue` in between, with the frame that runs, if the body takes more than `seconds` of wall time.

    A brain that uses SIGALRM itself keeps it, and is not noticed; one in C is noticed when it returns to Python.
    """
    if signal.getsignal(signal.SIGALRM) is not signal.SIG_DFL:
        yield
        return

    def ring(_number: int, frame: FrameType | None) -> None:
        overdue(frame)

    signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        if signal.getsignal(signal.SIGALRM) is ring:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, signal.SIG_DFL)
