"""Keys of a terminal, read one by one without waiting for Enter, arrows by name."""

import os
import re
import select
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from schemas.errors import TouchlineError

UP, DOWN, RIGHT, LEFT = "up", "down", "right", "left"
_ARROWS = {"A": UP, "B": DOWN, "C": RIGHT, "D": LEFT}
_KEY = re.compile(r"\x1b[\[O]([A-D])|\x1b[\[O][\d;]*.?|(.)", re.DOTALL)

KeyReader = Callable[[float], str]
"""Returns the typed characters; waits up to the given time, s."""


def parse_keys(text: str) -> list[str]:
    """The keys in a terminal's input; escape sequences other than arrows are left out."""
    found = [_ARROWS[arrow] if arrow else plain for arrow, plain in _KEY.findall(text)]
    return [key for key in found if key]


@contextmanager
def terminal(command: str) -> Iterator[KeyReader]:
    """The keys of the terminal of a command.

    Raises:
        TouchlineError: stdin is not a terminal.
    """
    if not sys.stdin.isatty():
        raise TouchlineError(
            f"{command} reads keys from a terminal, but stdin is not a terminal; run it in a separate terminal"
        )
    import termios
    import tty

    descriptor = sys.stdin.fileno()
    before = termios.tcgetattr(descriptor)

    def keys(timeout: float) -> str:
        ready, _, _ = select.select([descriptor], [], [], timeout)
        return os.read(descriptor, 256).decode(errors="ignore") if ready else ""

    try:
        tty.setcbreak(descriptor)
        yield keys
    finally:
        termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
