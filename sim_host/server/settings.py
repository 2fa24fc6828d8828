"""What a host process is started with."""

from pathlib import Path

from pydantic import Field

from schemas.bus.settings import ListenSettings
from schemas.config.match_config import MatchConfig


class HostSettings(ListenSettings):
    """One host process: the match that it plays, and where it listens."""

    config: MatchConfig = Field(default_factory=MatchConfig)
    """The match."""
    launch_token: str | None = None
    """Secret of the launch: only agents that know it may play. None admits every agent."""
    announcement: Path | None = None
    """File in which the host announces its endpoint as soon as it listens."""
