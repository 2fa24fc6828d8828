"""What a process does, in files that survive it: if it dies or hangs, those who wait for it read there why.

A brain in C may end the process, or hold the interpreter's lock for ever; no Python code of the process runs then.
"""

import faulthandler
import mmap
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

_NOTE, _STACK = "note", "stack"
_SIZE = 128
_LEAST_S = 0.25
"""Wall time between two renewals of the deadline: each starts a thread."""


@dataclass(frozen=True, slots=True)
class ProcessNote:
    """What a process has left."""

    doing: str = ""
    """What it did last, as it noted itself."""
    stack: str = ""
    """The stack of its threads when it did not renew its deadline; empty if it ended in another way."""


class _Files:
    """The files of this process."""

    def __init__(self, folder: Path) -> None:
        with (folder / _NOTE).open("wb+") as file:
            file.truncate(_SIZE)
            self.note = mmap.mmap(file.fileno(), _SIZE)
        self.stack: TextIO = (folder / _STACK).open("w")
        self.renewed = 0.0


_files: _Files | None = None


def open_note(folder: Path) -> None:
    """Keep the note of this process in a folder; without this call, the functions below do nothing."""
    global _files
    _files = _Files(folder)


def note(doing: str) -> None:
    """Note what this process does now; no system call, so that it may be called with each decision of a brain."""
    if _files is not None:
        _files.note[:] = doing.encode()[:_SIZE].ljust(_SIZE, b"\0")


def end_unless_renewed(seconds: float) -> None:
    """End this process after so much wall time unless this is called again before, and leave its stack.

    A thread in C counts the time: it needs no lock of the interpreter.
    """
    if _files is not None and time.monotonic() - _files.renewed >= _LEAST_S:
        _files.renewed = time.monotonic()
        faulthandler.dump_traceback_later(seconds, exit=True, file=_files.stack)


def do_not_end() -> None:
    """Undo `end_unless_renewed`."""
    if _files is not None:
        faulthandler.cancel_dump_traceback_later()
        _files.renewed = 0.0


def read_note(folder: Path) -> ProcessNote:
    """What a process that has ended left in a folder."""
    note_file, stack_file = folder / _NOTE, folder / _STACK
    if not note_file.exists() or not stack_file.exists():
        return ProcessNote()
    doing = note_file.read_bytes().rstrip(b"\0").decode("utf-8", "replace")
    return ProcessNote(doing, stack_file.read_text("utf-8", "replace"))
