"""How the programs of a team are confined: `[limits]`, `[teams.cyan.limits]` and `isolate` of a match file."""

from enum import StrEnum
from typing import Annotated

from pydantic import Field

from schemas.config.config_model import ConfigModel

CpuTime = Annotated[float, Field(ge=1, le=1e9)]
Memory = Annotated[float, Field(ge=0.1, le=10_000)]
OpenFiles = Annotated[int, Field(ge=32, le=1_000_000)]
Processes = Annotated[int, Field(ge=16, le=100_000)]
FileSize = Annotated[float, Field(ge=0.001, le=1e6)]


class Isolation(StrEnum):
    """What separates the robots of a team from other programs of the machine, in addition to their limits."""

    NONE = "none"
    """Nothing: they run as the user who launches the match."""
    BUBBLEWRAP = "bubblewrap"
    """A read-only view of the system and process ids of its own for each robot, by the program `bwrap`."""


class Limits(ConfigModel):
    """What the processes of one robot may use of its machine; all of them inherit these limits."""

    cpu_time: CpuTime = 3600.0
    """CPU time of each process in s. An hour of a whole core; matches last minutes."""
    memory: Memory = 4.0
    """Memory of each process in GB. Above what numpy and a network of torch need, too little to fill a machine."""
    open_files: OpenFiles = 1024
    """Open files of each process. What Linux allows by default."""
    processes: Processes = 256
    """Processes and threads; root has no such limit. A robot has about a dozen threads, and numpy some per core."""
    file_size: FileSize = 1000.0
    """Size of each written file, in MB. More than a model, less than a disk."""

    def breach(self, limit: str) -> str:
        """What a robot did that exceeded a limit, named by its field, and the remedy."""
        what, option = _BREACHES[limit].format(getattr(self, limit)), limit.replace("_", "-")
        return f"it {what}; raise [limits] {limit}, or --{option} of touchline team"


_BREACHES = {
    "cpu_time": "used more than {:g} s of CPU time",
    "memory": "used more than {:g} GB of memory",
    "open_files": "opened more than {} files at once",
    "file_size": "wrote more than {:g} MB into one file",
}
"""Limit → what exceeds it."""


class TeamLimits(ConfigModel):
    """Limits of the robots of one team that replace the match's."""

    cpu_time: CpuTime | None = None
    """CPU time of each process in s; None for the match's."""
    memory: Memory | None = None
    """Memory of each process in GB; None for the match's."""
    open_files: OpenFiles | None = None
    """Open files of each process; None for the match's."""
    processes: Processes | None = None
    """Processes and threads of a robot; None for the match's."""
    file_size: FileSize | None = None
    """Size of each written file, in MB; None for the match's."""

    def over(self, limits: Limits) -> Limits:
        """The limits of the match, replaced by this team's where it has some."""
        return limits.model_copy(update=self.model_dump(exclude_none=True))
