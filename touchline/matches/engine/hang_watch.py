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
    stack: str = ""
    """The stack of its threads when a brain did not answer; empty if it ended in another way."""


class HangWatch:
    """The deadline of the brains of one match; the process ends where it is not renewed in time."""

    def __init__(self, folder: Path | None, seconds: float = HANG_S) -> None:
        """`folder` gets the note; without it nothing is watched."""
        self._seconds = seconds
        self._clock = WallClock()
        self._renewed = 0.0
        self._note = os.open(folder / _ACTING, os.O_CREAT | os.O_WRONLY) if folder is not None else None
        self._stack = (folder / _STACK).open("w") if folder is not None else None

    def note(self, acting: str | None, *, is_built: bool = True) -> None:
        """Note the robot whose brain gets control; None while none has it."""
        if self._note is not None:
            text = f"{int(is_built)}{acting or ''}".encode()[:_SIZE].ljust(_SIZE, b"\0")
            os.pwrite(self._note, text, 0)

    @contextmanager
    def acting(self, what: str) -> Iterator[None]:
        """Note who acts, and begin the time anew; nobody acts afterwards."""
        self.note(what)
        self.renew()
        try:
            yield
        finally:
            self.note(None)

    def renew(self) -> None:
        """Begin the time anew."""
        now = self._clock.now()
        if self._stack is not None and now - self._renewed >= HANG_RENEW_S:
            self._renewed = now
            faulthandler.dump_traceback_later(self._seconds + HANG_RENEW_S, exit=True, file=self._stack)

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
    return Note(text[1:], text[:1] != "0", stack.read_text("utf-8", "replace"))
