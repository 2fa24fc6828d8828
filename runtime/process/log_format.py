"""How a process writes its log, as its settings name it."""

from enum import StrEnum
from typing import Annotated

from schemas.config.settings import CommandLine, Settings

VARIABLE = "TOUCHLINE_LOG"
"""Environment variable with the format of processes that are given none."""


class LogFormat(StrEnum):
    """How a process writes its log."""

    TEXT = "text"
    JSON = "json"


class LogSettings(Settings):
    """How a process writes its log."""

    log_format: Annotated[LogFormat | None, CommandLine(environment=VARIABLE)] = None
    """Format of the log: lines of text, or one JSON object a line; by default text."""
