"""The settings of a recorder process."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from runtime.bus.settings import ClientSettings, Endpoint
from runtime.process.log_format import LogSettings
from schemas.config.match_config import MatchConfig
from schemas.config.settings import RecordOptions


class RecorderSettings(ClientSettings, LogSettings):
    """One recorder process: its match, its file, and what goes into it."""

    out: Path
    """The file, *.mcap; if a recorder of this match has left it, its next part, which has what is missing."""
    name: str = "recorder"
    """Name of this recorder; the recorders of a match have different names."""
    record: RecordOptions = RecordOptions()
    """What is recorded, and into which parts."""
    patience: Annotated[float, Field(ge=0)] = 30.0
    """Longest wait for a host, in s of wall time."""
    keys: list[str] = Field(default_factory=list)
    """Record these keys of any Zenoh network, as robot/** or **, and no match; may be given several times."""
    listen: Endpoint | None = None
    """With --keys: listen here for those who publish, instead of --connect, which is tcp/127.0.0.1:7447."""
    insecure: bool = False
    """With --listen: admit everybody, also from other machines."""
    config: MatchConfig | None = None
    """The match file, to be stored in the recording."""
