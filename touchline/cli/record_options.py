"""What a recording shall hold and how it is cut into files: the same words for a match and for a recorder by itself."""

from dataclasses import dataclass
from typing import Any

from touchline.cli import options


@dataclass(frozen=True)
class RecordOptions:
    """What is recorded, and into which files."""

    sights: options.Sights = False
    include: options.Include = None
    exclude: options.Exclude = None
    split_size: options.SplitSize = None
    split_duration: options.SplitDuration = None
    keep: options.Keep = None
    snapshot: options.Snapshot = None
    no_viz: options.NoViz = False

    def flags(self) -> dict[str, Any]:
        """For the section [record] of a match, as `options.read_match` takes them; what was not said is left to it."""
        return {
            "record__sights": self.sights or None,
            "record__include": self.include or None,
            "record__exclude": self.exclude or None,
            "record__split_size": self.split_size,
            "record__split_duration": self.split_duration,
            "record__keep": self.keep,
            "record__snapshot": self.snapshot,
            "record__viz": False if self.no_viz else None,
        }

    def arguments(self) -> list[str]:
        """The same for a recorder's command line."""
        values = {
            "split-size": self.split_size,
            "split-duration": self.split_duration,
            "keep": self.keep,
            "snapshot": self.snapshot,
        }
        return [
            *(word for word, wanted in (("--sights", self.sights), ("--no-viz", self.no_viz)) if wanted),
            *(f"--include={expression}" for expression in self.include or ()),
            *(f"--exclude={expression}" for expression in self.exclude or ()),
            *(f"--{word}={value}" for word, value in values.items() if value is not None),
        ]
