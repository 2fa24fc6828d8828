"""What a process is started with: the base of its settings, and what the recorder has in common with the match file.

Each kind of process has one model of its own: `HostSettings`, `AgentSettings`, `GatewaySettings`, `RecorderSettings`. A
field of it is a key of its settings file and an option of its command: name, type, default, limits, and the docstring
as the option's help.
"""

from dataclasses import dataclass
from typing import Annotated

from pydantic import Field, model_validator

from schemas.message import Part

DEFAULT_MATCH = "friendly"
"""The match that is played, and that a process joins, when no other is named."""


@dataclass(frozen=True, slots=True)
class CommandLine:
    """What the command line has to know of a field beyond the field itself; stands in its `Annotated`."""

    environment: str | None = None
    """Environment variable that stands in for the option."""
    metavar: str | None = None
    """How the value is written, `HOST:PORT`."""


class Settings(Part):
    """The base of all settings: frozen, closed, and explained by the docstrings of its fields."""


class RecordOptions(Settings):
    """What is recorded, and into which files; the section `[record]` of a match file has the same keys."""

    sights: bool = False
    """Record what every robot perceives, too."""
    include: list[str] = Field(default_factory=list)
    """Record only these keys, as robot/*/command or team/**; may be given several times."""
    exclude: list[str] = Field(default_factory=list)
    """Leave these keys out; may be given several times."""
    split_size: Annotated[float | None, Field(gt=0)] = None
    """MB after which the recording continues in the next file."""
    split_duration: Annotated[float | None, Field(gt=0)] = None
    """Simulated s after which the recording continues in the next file."""
    keep: Annotated[int | None, Field(ge=1)] = None
    """Number of files that are kept, the newest; by default all."""
    snapshot: Annotated[float | None, Field(gt=0)] = None
    """Write only the last so many simulated s before each goal and on request, each time into a file of its own."""
    viz: bool = True
    """Add what Foxglove, Lichtblick and Rerun draw: /tf and /viz/*."""

    @property
    def in_several_files(self) -> bool:
        """Whether the recording may consist of more than one file."""
        return any(limit is not None for limit in (self.split_size, self.split_duration, self.snapshot))

    @model_validator(mode="after")
    def _limits_agree(self) -> "RecordOptions":
        if self.keep is not None and not self.in_several_files:
            raise ValueError(f"keep {self.keep} needs several files; add split_size, split_duration or snapshot")
        if self.snapshot is not None and (self.split_size is not None or self.split_duration is not None):
            raise ValueError("snapshot writes files of its own; leave split_size and split_duration out")
        return self
