"""A position in MCAP files of any writer, for the player."""

from collections.abc import Callable
from typing import Any

from recordings.reading.log_order import Log, LogMessage


class LogCursor:
    """Reads the messages of a log; times in ns since its first message."""

    finished = True
    start_ns = 0

    def __init__(self, log: Log) -> None:
        """Open at the beginning."""
        self._log = log
        self.seek(0)

    @property
    def end_ns(self) -> int:
        """Time of the last message."""
        return self._log.end_ns

    def grow(self) -> bool:
        """A log does not grow."""
        return False

    def peek(self) -> LogMessage | None:
        """The next message; None at the end.

        Raises:
            TouchlineError: a file is damaged there.
        """
        return self._next

    def skip(self) -> None:
        """Move past the next message.

        Raises:
            TouchlineError: a file is damaged there.
        """
        self._next = next(self._messages, None)

    def seek(self, ns: int) -> None:
        """Move to the first message at `ns` or later.

        Raises:
            TouchlineError: a file is damaged there.
        """
        self._messages = self._log.messages(ns)
        self.skip()

    def latched(self, ns: int, is_latched: Callable[[Any], bool]) -> list[LogMessage]:
        """None: which messages describe a state, only their robots know, and an old command must not be repeated."""
        del ns, is_latched
        return []
