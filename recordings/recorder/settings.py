"""The settings of a recorder process."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from schemas.bus.settings import ClientSettings
from schemas.config.match_config import MatchConfig
from schemas.config.settings import LogSettings, RecordOptions


class RecorderSettings(ClientSettings, LogSettings):
    """One recorder process: its match, its file, and what goes into it."""

    out: Path
    """The file, *.mcap."""
    name: str = "recorder"
    """Name of this recorder; the recorders of a match have different names."""
    resume: bool = False
    """Continue the recording that a recorder of this match has left unfinished, and fill the gap from the host."""
    record: RecordOptions = RecordOptions()
    """What is recorded, and into which files."""
    patience: Annotated[float, Field(ge=0)] = 30.0
    """Longest wait for a host, in s of wall time."""
    config: MatchConfig | None = None
    """The match file, to be stored in the recording."""
