"""Limits the logs of a match: each keeps its beginning and its newest lines, and has a line that says so.

A process writes at the end of its log, wherever that is, so the log can be cut while the process writes.
"""

import os
from pathlib import Path

MOST_BYTES = 5_000_000
"""Bytes of a log that are kept from its beginning."""
_NEWEST_BYTES = 1_000_000
"""Bytes behind them after which the log is cut again."""
_LINE_BYTES = 4096
"""A longer line is cut in two."""


class LogLimit:
    """Limits logs; `check` has to be called periodically for each."""

    def __init__(self, most_bytes: int = MOST_BYTES, newest_bytes: int = _NEWEST_BYTES) -> None:
        self._most, self._newest = most_bytes, newest_bytes
        self._kept: dict[Path, int] = {}

    def check(self, log: Path) -> str:
        """Cut a log that has become too long; returns a sentence when that happens for the first time, else ""."""
        try:
            size = log.stat().st_size
        except FileNotFoundError:
            return ""
        if (kept := self._kept.get(log)) is not None:
            if size > kept + self._newest:
                os.truncate(log, kept)
            return ""
        if size <= self._most:
            return ""
        begins = self._end_of_line(log)
        os.truncate(log, begins)
        limit = f"{self._most / 1e6:g} MB"
        line = f"touchline: this log is limited to {limit}; later lines are left out here, except the newest\n".encode()
        with log.open("ab", buffering=0) as file:
            file.write(line)
            self._kept[log] = file.tell()  # the process may have written before the line
        return (
            f"{log.stem} has written more than {limit} into {log}, which keeps these and the newest lines; print less"
        )

    def _end_of_line(self, log: Path) -> int:
        """The end of the last whole line within the limit."""
        start = max(0, self._most - _LINE_BYTES)
        with log.open("rb") as file:
            file.seek(start)
            found = file.read(self._most - start).rfind(b"\n")
        return start + found + 1 if found >= 0 else self._most
