"""What a host process is started with."""

from pathlib import Path

from pydantic import Field

from schemas.bus.settings import ListenSettings
from schemas.config.match_config import MatchConfig


class HostSettings(ListenSettings):
    """One host process: the match that it plays, and where it listens."""

    config: MatchConfig = Field(default_factory=MatchConfig)
    """The match."""
    outcome: Path | None = None
    """File for the result at the end, for the program that launched the host."""
