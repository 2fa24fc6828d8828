"""Settings of processes: their base class, and the options that the recorder and the match file share.

Each kind of process has its own model: `HostSettings`, `AgentSettings`, `GatewaySettings`, `RecorderSettings`. Each
field is a key of the settings file and an option of the command, with its name, type, default and limits, and its
docstring as help.
"""

from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

from schemas.config.config_model import ConfigModel

DEFAULT_MATCH = "friendly"
"""The default name of a match, for hosts and for processes that join one."""


@dataclass(frozen=True, slots=True)
class CommandLine:
    """Details of a field's option on the command line, in the field's `Annotated`."""

    environment: str | None = None
    """Environment variable with the default of the option."""
    metavar: str | None = None
    """The form of the value in the help, `HOST:PORT`."""


class Settings(ConfigModel):
    """The base of all settings: immutable, without unknown fields, described by the docstrings of its fields."""


class RecordOptions(Settings):
    """What is recorded, and into which parts; the section `[record]` of a match file has the same keys."""

    sights: bool = False
    """Record what every robot perceives, too."""
    include: list[str] = Field(default_factory=list)
    """Record only these keys, as robot/*/command or team/**; may be given several times."""
    exclude: list[str] = Field(default_factory=list)
    """Leave these keys out; may be given several times."""
    part_size: Annotated[float | None, Field(gt=0)] = None
    """MB after which the recording continues in its next part: final.2.mcap."""
    part_duration: Annotated[float | None, Field(gt=0)] = None
    """Simulated s after which the recording continues in its next part."""
    viz: bool = True
    """Add what Foxglove, Lichtblick and Rerun draw: /tf and /viz/*."""
