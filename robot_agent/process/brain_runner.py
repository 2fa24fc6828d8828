"""Runs a brain in its own process, whose log gets the stack where the brain does not return."""

import sys
import threading
import traceback
import weakref
from types import FrameType

from robot_agent.loading.user_code import is_users, shown_path
from robot_agent.process.runner import Runner
from robot_agent.process.timing import HANG_S
from robot_agent.sdk.contract import Brain
from runtime.bus.contract import Bus, Subscription
from runtime.process.process_log import Level, log_line, log_note
from schemas.messages.sight import Sight

_LOOKS = 5
"""In `HANG_S`, whether a brain still thinks of the same sight. Another thread looks: an alarm of the process for each
sight would cost a third of an agent's CPU time."""


class BrainRunner(Runner):
    """Answers each sight by a brain, in the thread that makes the runner; the brain is not interrupted."""

    def __init__(self, bus: Bus, brain: Brain, robot: str, sights: Subscription | None = None) -> None:
        super().__init__(bus, brain, robot, sights)
        self.thread = threading.get_ident()
        self.thinks_of: Sight | None = None
        """What the brain has been asked to answer."""
        threading.Thread(target=_watch, args=(weakref.ref(self),), name=f"watch of {robot}", daemon=True).start()

    def _think(self, sight: Sight) -> bytes:
        self.thinks_of = sight
        try:
            return super()._think(sight)
        finally:
            self.thinks_of = None


def _watch(watched: "weakref.ref[BrainRunner]") -> None:
    """Report each sight that a brain has not answered for `HANG_S`, as long as there is a runner.

    A brain in C is noticed when it returns to Python.
    """
    seen, looks = None, 0
    while (runner := watched()) is not None:
        sight, thread = runner.thinks_of, runner.thread
        looks = looks + 1 if sight is not None and sight is seen else 0
        if looks == _LOOKS and sight is not None:
            _report(sight, sys._current_frames().get(thread))
        seen = sight
        del runner
        threading.Event().wait(HANG_S / _LOOKS)


def _report(sight: Sight, frame: FrameType | None) -> None:
    """Log the stack of a brain that does not return, of the innermost `frame`, and note it."""
    stack = [one for one in traceback.extract_stack(frame) if is_users(one.filename)]
    if stack:
        log_line("".join(traceback.format_list(stack)), Level.WARNING, tick=sight.tick)
        log_note(
            f"act has not returned for {HANG_S:g} s in {shown_path(stack[-1].filename)}",
            f"{sight.robot} is in line {stack[-1].lineno} at tick {sight.tick}; its log has the stack",
        )
