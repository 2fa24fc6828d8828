"""The failure of a brain's `act`, and its report: a traceback, then one line with the place and the fault."""

import traceback
from bdb import BdbQuit
from collections.abc import Callable
from typing import Any

from robot_agent.loading.limit_reached import limit_reached
from robot_agent.loading.user_code import ReturnedError, definition_of, place_of, sentence_of
from schemas.wire.faults import FaultError

_NO_TERMINAL = "a robot's process has no terminal; write breakpoint(), which it skips, in place of pdb.set_trace()\n"


class RobotError(Exception):
    """What moves a robot has failed: its brain, or its program."""

    def report(self) -> str:
        """The failure as text, whose last line names the tick and the fault."""
        return f"{self}\n"


class BrainError(RobotError):
    """The brain raised, or returned something that is not a command; the cause is what it raised."""

    def __init__(self, tick: int, act: Callable[..., Any], returned: object = None) -> None:
        """`returned` is what it returned in place of a command, unless it raised."""
        super().__init__(f"act failed at tick {tick}")
        self.tick = tick
        self._act = act
        self._returned = returned

    def report(self) -> str:
        """The failure as text; the last line names the tick, the file and line, and the fault.

        Where a limit of the process made it fail, or a debugger without a terminal, one more line has the remedy.

        An invalid command is a fault of the values, not of the code that checks them: its report is one line.
        """
        cause = self.__cause__
        if cause is None:
            place = definition_of(self._act)
            return f"act returned {self._returned!r} at tick {self.tick}{place}; return a Command\n"
        place = place_of(cause)
        if isinstance(cause, FaultError | ReturnedError):
            return f"act failed at tick {self.tick}{place}: {cause}\n"
        limit = limit_reached(cause)
        remedy = f"limit reached: {limit}\n" if limit else _NO_TERMINAL if isinstance(cause, BdbQuit) else ""
        return f"{_frames(cause)}act raised at tick {self.tick}{place}: {sentence_of(cause)}\n{remedy}"


def _frames(cause: BaseException) -> str:
    """The traceback from the brain's frame on, without its last line."""
    below = cause.__traceback__.tb_next if cause.__traceback__ is not None else None
    whole = traceback.TracebackException(type(cause), cause, below)
    return "".join(whole.format()).removesuffix("".join(whole.format_exception_only()))
