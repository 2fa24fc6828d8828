"""What a recorder process is started with."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from schemas.bus.settings import ClientSettings
from schemas.config.match_config import MatchConfig
from schemas.config.settings import RecordOptions


class RecorderSettings(ClientSettings):
    """One recorder process: its match, its file, and what goes into it."""

    out: Path
    """The file, *.mcap."""
    name: str = "recorder"
    """Name of this recorder; two of one match differ."""
    resume: bool = False
    """Continue the recording that a recorder of this match has left unfinished, and fill the gap from the host."""
    record: RecordOptions = RecordOptions()
    """What is recorded, and into which files."""
    patience: Annotated[float, Field(ge=0)] = 30.0
    """s of wall time to wait for a host that is not there."""
    config: MatchConfig | None = None
    """The match as it was set up, to be kept in the file."""
