"""Ends a brain that does not answer, in the main thread of a process."""

import signal
import threading
from types import FrameType, TracebackType
from typing import Self

from touchline.matches.engine.process_note import do_not_end, end_unless_renewed, note

HANG_S = 10.0
"""Wall time in s for which a brain may be silent. Chosen here: a thousand times what a decision takes."""
_GRACE_S = 2.0
"""Wall time in s after which a process ends whose brain could not be interrupted."""


class HungError(BaseException):
    """A brain did not answer in time. No `Exception`, so that no `except Exception` of a brain catches it."""


class HangLimit:
    """Raises `HungError` in its block if `restart` is not called for some time while a brain has control.

    The alarm interrupts Python code and sleeps. It does not interrupt a library in C that never returns, nor a brain
    that catches everything: a process that plays nothing but this match ends then, and leaves a note. In a thread
    other than the main thread there is no alarm: a match there has a process of its own.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self.robot: str | None = None
        """The robot whose answer is waited for."""

    def wait_for(self, robot: str | None) -> None:
        """Note the robot whose answer is waited for; None while no brain has control."""
        self.robot = robot
        note(robot or "")

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
            do_not_end()

    def restart(self) -> None:
        """Begin the time anew."""
        if self._is_main:
            signal.setitimer(signal.ITIMER_REAL, self._seconds)
            end_unless_renewed(self._seconds + _GRACE_S)

    def _raise(self, number: int, frame: FrameType | None) -> None:
        del number, frame
        if self.robot is None:  # no brain has control: this process is slow, as on a machine with too much work
            self.restart()
            return
        raise HungError(f"no answer within {self._seconds:g} s")
