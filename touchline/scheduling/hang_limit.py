"""Ends a brain that does not answer, in the main thread of a process."""

import signal
import threading
from types import FrameType, TracebackType
from typing import Self

HANG_S = 10.0
"""Wall time in s for which a brain may be silent. Chosen here: a thousand times what a decision takes."""


class HungError(BaseException):
    """A brain did not answer in time. No `Exception`, so that no `except Exception` of a brain catches it."""


class HangLimit:
    """Raises `HungError` in its block if `restart` is not called for some time.

    The alarm interrupts Python code and sleeps. It does not interrupt a library in C that never returns, and there is
    none outside of the main thread: a match there has a process of its own.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds

    def __enter__(self) -> Self:
        self._is_main = threading.current_thread() is threading.main_thread()
        if self._is_main:
            self._before = signal.signal(signal.SIGALRM, self._raise)
        self.restart()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._is_main:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, self._before)

    def restart(self) -> None:
        """Begin the time anew."""
        if self._is_main:
            signal.setitimer(signal.ITIMER_REAL, self._seconds)

    def _raise(self, number: int, frame: FrameType | None) -> None:
        del number, frame
        raise HungError(f"no answer within {self._seconds:g} s")
