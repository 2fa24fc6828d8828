"""What a host process is started with."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from runtime.bus.settings import ListenSettings
from runtime.process.log_format import LogSettings
from schemas.config.match_config import MatchConfig
from schemas.config.settings import CommandLine
from schemas.wire.message import Name


class HostSettings(ListenSettings, LogSettings):
    """One host process: the match that it plays, and where it listens."""

    config: MatchConfig = Field(default_factory=MatchConfig)
    """The match."""
    outcome: Path | None = None
    """File for the result at the end, for the program that launched the host."""
    launch_token: Annotated[str | None, CommandLine(environment="TOUCHLINE_LAUNCH_TOKEN")] = None
    """Secret that an agent must know to play; by default every agent may."""
    admit: list[Name] = Field(default_factory=list)
    """A recorder that a lockstep host waits for, by name; may be given several times."""
    announcement: Path | None = None
    """File in which the host announces its endpoint as soon as it listens."""
