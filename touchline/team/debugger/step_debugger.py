"""Python's debugger around the calls of a brain: breakpoints stay from one tick to the next, and so does stepping."""

import inspect
import pdb
import sys
import traceback
from types import FrameType, TracebackType

from robot_agent.loading.user_code import is_users
from robot_agent.sdk.contract import Brain
from schemas.messages.command import Command
from schemas.messages.sight import Sight


class StepDebugger(pdb.Pdb):
    """Stops in the brain's own code, first at the sight of one tick.

    `n` past the end of `act` stops before the next one, `c` does not. Code of this library, of Python and of installed
    packages is passed, except at breakpoints.
    """

    def __init__(self, first: float) -> None:
        """`first` is the simulated time in s of the first sight before which it stops."""
        super().__init__(nosigint=True)
        self._first = first
        self._is_stepping = True

    def act(self, brain: Brain, sight: Sight) -> Command:
        """Call a brain with a sight, stopped before its first line or running to its breakpoints.

        Raises:
            BdbQuit: the user has quit.
        """
        if sight.time < self._first:
            return brain.act(sight)
        self.reset()
        if not self._is_stepping:
            self.botframe = inspect.currentframe()
            self.set_continue()
            if not self.breaks:
                return brain.act(sight)
        sys.settrace(self.trace_dispatch)
        try:
            return brain.act(sight)
        finally:
            sys.settrace(None)

    def stop_here(self, frame: FrameType) -> bool:
        """Whether stepping stops in this frame."""
        return super().stop_here(frame) and is_users(frame.f_code.co_filename)

    def user_call(self, frame: FrameType, argument_list: None) -> None:
        """Stop at a call, or before the first line of a function that other code than the brain's calls."""
        if frame.f_back is not None and is_users(frame.f_back.f_code.co_filename):
            super().user_call(frame, argument_list)

    def set_continue(self) -> None:
        """Go on to the next breakpoint, in this tick or a later one."""
        self._is_stepping = False
        super().set_continue()

    def set_step(self) -> None:
        """Stop after one line, before the next `act` at the latest."""
        self._is_stepping = True
        super().set_step()

    def set_next(self, frame: FrameType) -> None:
        """Stop at the next line of this frame, before the next `act` at the latest."""
        self._is_stepping = True
        super().set_next(frame)

    def set_return(self, frame: FrameType) -> None:
        """Stop at the end of this frame, before the next `act` at the latest."""
        self._is_stepping = True
        super().set_return(frame)


def examine(raised: TracebackType | None) -> None:
    """Open the debugger where an exception was raised, or in the brain's code that called what raised it."""
    debugger = pdb.Pdb(nosigint=True)
    debugger.reset()
    own = [is_users(frame.f_code.co_filename) for frame, _ in traceback.walk_tb(raised)]
    if True in own and not own[-1]:
        debugger.cmdqueue.append(f"up {own[::-1].index(True)}")
    debugger.interaction(None, raised)
