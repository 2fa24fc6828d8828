"""How a process writes its log, as its settings name it."""

from enum import StrEnum

VARIABLE = "TOUCHLINE_LOG"
"""Environment variable with the format of processes that are given none."""


class LogFormat(StrEnum):
    """How a process writes its log."""

    TEXT = "text"
    JSON = "json"
