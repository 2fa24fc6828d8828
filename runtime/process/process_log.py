"""The log of a process: lines for people, or one JSON object a line for programs.

Every process writes its log with `log_line`, or with the standard library's `logging`. In JSON both become objects with
the time (UTC), the process and its id, the level, the robot of an agent, and the message.
"""

import json
import logging
import os
import sys
from contextlib import suppress
from datetime import UTC, datetime
from enum import StrEnum
from typing import Any, TextIO

from runtime.process.clock import WallClock
from runtime.process.log_format import VARIABLE, LogFormat
from schemas.errors import TouchlineError

NOTE = "note: "
"""Begins a line that the launcher of the process shows to its user."""


class Level(StrEnum):
    """How much a line matters."""

    INFO = "info"
    WARNING = "warning"
    ERROR = "error"


class _ProcessLog:
    """The format of this process, and what it adds to each JSON line."""

    format = LogFormat.TEXT
    process = "touchline"
    robot: str | None = None


_LOG = _ProcessLog()


def configure_log(
    process: str, log_format: LogFormat | None = None, robot: str | None = None, text: str | None = None
) -> None:
    """Set the format of this process's log: the given one, or the environment's, or text.

    A process that has configured `logging` itself keeps that.

    Args:
        process: kind of the process, `host`.
        log_format: None takes the environment's.
        robot: the robot of an agent.
        text: format of the standard library's records as text; None leaves their configuration to the process.

    Raises:
        TouchlineError: the environment has an unknown format.
    """
    _LOG.format, _LOG.process, _LOG.robot = log_format or _format_of_environment(), process, robot
    if _LOG.format is LogFormat.JSON:
        handler = logging.StreamHandler(sys.stderr)
        handler.setFormatter(_JsonFormatter())
        logging.basicConfig(level=logging.INFO, handlers=[handler])
    elif text is not None:
        logging.basicConfig(level=logging.INFO, stream=sys.stderr, format=text)


def log_line(
    message: str, level: Level = Level.INFO, stream: TextIO | None = None, *, prefix: str = "", **fields: Any
) -> None:
    """Write a line to stderr, or to `stream`, at once; on a full disk it is lost, and the process goes on.

    Args:
        message: the line.
        level: how much it matters.
        stream: None for stderr.
        prefix: what precedes the message as text.
        fields: what JSON has besides, such as figures.
    """
    out = stream if stream is not None else sys.stderr
    line = (
        _json_line(WallClock.unix_ns() * 1e-9, level.value, message, fields)
        if _LOG.format is LogFormat.JSON
        else f"{prefix}{message}"
    )
    with suppress(OSError):
        out.write(line.rstrip("\n") + "\n")
        out.flush()


def log_note(subject: str, text: str, **fields: Any) -> None:
    """Write a line that the launcher of this process shows to its user; of equal subjects it shows the first one."""
    log_line(f"{NOTE}{subject}: {text}", Level.WARNING, **fields)


def message_of(line: str) -> str:
    """The message of a line of a log, in whichever format it was written."""
    if not line.startswith('{"time"'):
        return line
    try:
        content = json.loads(line)
    except ValueError:
        return line  # cut off
    message = content.get("message") if isinstance(content, dict) else None
    return message if isinstance(message, str) else line


class _JsonFormatter(logging.Formatter):
    """A record of the standard library as one JSON object."""

    def format(self, record: logging.LogRecord) -> str:
        """The line of a record."""
        message = record.getMessage()
        if record.exc_info:
            message = f"{message}\n{self.formatException(record.exc_info)}"
        return _json_line(record.created, record.levelname.lower(), message, {"logger": record.name})


def _json_line(unix_s: float, level: str, message: str, fields: dict[str, Any]) -> str:
    time = datetime.fromtimestamp(unix_s, UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
    head = {"time": time, "process": _LOG.process, "pid": os.getpid(), "level": level, "robot": _LOG.robot}
    return json.dumps({**head, "message": message, **fields}, ensure_ascii=False)


def _format_of_environment() -> LogFormat:
    name = os.environ.get(VARIABLE) or LogFormat.TEXT.value
    try:
        return LogFormat(name)
    except ValueError:
        raise TouchlineError(f"{VARIABLE} is {name!r}; set it to {' or '.join(LogFormat)}") from None
