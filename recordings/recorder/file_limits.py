"""When a recorder finishes a file and begins the next one, and how many files it keeps."""

from dataclasses import dataclass
from typing import Self

from schemas.config.settings import RecordOptions


@dataclass(frozen=True, slots=True)
class FileLimits:
    """When a file is finished and the next one begins, and how many files are kept."""

    size: int | None = None
    """Bytes of a file."""
    duration: float | None = None
    """Simulated s in a file."""
    keep: int | None = None
    """Number of finished files that are kept, the newest; None for all."""
    snapshot: float | None = None
    """Simulated s that are held in memory, and written only after a goal or on request."""

    @classmethod
    def of(cls, options: RecordOptions) -> Self:
        """The limits in the options of a recorder, where sizes are in MB."""
        size = round(options.split_size * 1e6) if options.split_size is not None else None
        return cls(size, options.split_duration, options.keep, options.snapshot)

    @property
    def is_split(self) -> bool:
        """Whether the recording may have several files."""
        return any(limit is not None for limit in (self.size, self.duration, self.snapshot))


ONE_FILE = FileLimits()
