"""Ends a process in which a brain never answers, and leaves a note on it: who acted, and the stack.

A thread in C counts the time: a brain in C may hold the interpreter's lock for ever, and no Python code runs then.
"""

import faulthandler
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from robot_agent.process.timing import HANG_S
from runtime.process.clock import WallClock
from touchline.timing import HANG_RENEW_S

_ACTING, _STACK = "acting", "stack"
_SIZE = 128
"""Bytes of the note, so that a new one covers the last one."""


@dataclass(frozen=True, slots=True)
class Note:
    """What a process has left."""

    acting: str = ""
    """The robot whose brain had control, in a check with what it did; empty if none had."""
    is_built: bool = True
    """Whether it acted; otherwise it was built."""
    limit_s: float = 0.0
    """The wall time in s that it had."""
    stack: str = ""
    """The stack of its threads when a brain did not answer; empty if it ended in another way."""


class HangWatch:
    """The deadline of the brains of one match; the process ends where it is not renewed in time."""

    def __init__(self, folder: Path | None, seconds: float = HANG_S, building: float = 0.0) -> None:
        """`folder` gets the note; without it nothing is watched. A decision has `seconds` of wall time, and a robot to
        be built at least `building`: on a busy machine imports take long.
        """
        self._limits = max(seconds, building), seconds
        self._is_built = True
        self._clock = WallClock()
        self._renewed = 0.0
        self._note = os.open(folder / _ACTING, os.O_CREAT | os.O_WRONLY) if folder is not None else None
        self._stack = (folder / _STACK).open("w") if folder is not None else None

    def note(self, acting: str | None, *, is_built: bool = True) -> None:
        """Note the robot whose brain gets control, None while none has it, and begin the time anew."""
        if self._note is None or self._stack is None:
            return
        limit, now = self._limits[is_built], self._clock.now()
        os.pwrite(self._note, f"{int(is_built)}{limit:g} {acting or ''}".encode()[:_SIZE].ljust(_SIZE, b"\0"), 0)
        if is_built != self._is_built or now - self._renewed >= HANG_RENEW_S:
            self._is_built, self._renewed = is_built, now
            faulthandler.dump_traceback_later(limit + HANG_RENEW_S, exit=True, file=self._stack)

    @contextmanager
    def acting(self, what: str, *, is_built: bool = True) -> Iterator[None]:
        """Note who acts; nobody acts afterwards."""
        self.note(what, is_built=is_built)
        try:
            yield
        finally:
            self.note(None)

    def close(self) -> None:
        """End the watch."""
        if self._note is not None and self._stack is not None:
            faulthandler.cancel_dump_traceback_later()
            os.close(self._note)
            self._stack.close()


def read_note(folder: Path) -> Note:
    """What a process that has ended left in a folder."""
    note, stack = folder / _ACTING, folder / _STACK
    if not note.exists() or not stack.exists():
        return Note()
    text = note.read_bytes().rstrip(b"\0").decode("utf-8", "replace")
    head, _, acting = text.partition(" ")
    return Note(acting, head[:1] != "0", float(head[1:] or 0.0), stack.read_text("utf-8", "replace"))
