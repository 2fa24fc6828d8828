"""One finding of an examination."""

from enum import StrEnum
from typing import NamedTuple


class Status(StrEnum):
    """How a finding is."""

    OK = "ok"
    NOTE = "note"
    """Missing, but not needed to play."""
    WARNING = "warning"
    """The match can be played, but not well."""
    FAILED = "failed"
    """What was examined cannot be used."""


class Finding(NamedTuple):
    """What was examined, how it is, and what to do."""

    name: str
    status: Status
    text: str
    remedy: str = ""
    """What to do; empty where there is nothing to do."""
