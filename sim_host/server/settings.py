"""What a host process is started with."""

from pydantic import Field

from schemas.bus.settings import ListenSettings
from schemas.config.match_config import MatchConfig


class HostSettings(ListenSettings):
    """One host process: the match that it plays, and where it listens."""

    config: MatchConfig = Field(default_factory=MatchConfig)
    """The match."""
