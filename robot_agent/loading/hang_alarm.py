"""Notices a brain that does not return, by the alarm of the process; for the main thread."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def hang_alarm(seconds: float, overdue: Callable[[FrameType | None], None]) -> Iterator[None]:
    """Call `overdue` in between, with the frame that runs, if the body takes more than `seconds` of wall time.

    What it raises, the body raises. A brain that uses SIGALRM itself keeps it, and is not noticed; one in C is noticed
    when it returns to Python.
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
