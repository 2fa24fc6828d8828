"""When a recorder finishes a file and begins the next one."""

from dataclasses import dataclass
from typing import Self

from schemas.config.settings import RecordOptions


@dataclass(frozen=True, slots=True)
class FileLimits:
    """When a file is finished and the next one begins."""

    size: int | None = None
    """Bytes of a file."""
    duration: float | None = None
    """Simulated s in a file."""

    @classmethod
    def of(cls, options: RecordOptions) -> Self:
        """The limits in the options of a recorder, where sizes are in MB."""
        size = round(options.split_size * 1e6) if options.split_size is not None else None
        return cls(size, options.split_duration)

    @property
    def is_split(self) -> bool:
        """Whether the recording may have several files."""
        return any(limit is not None for limit in (self.size, self.duration))


ONE_FILE = FileLimits()
