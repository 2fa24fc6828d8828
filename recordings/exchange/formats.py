"""The table of exporters, in which a new format is a module and a row, and the importer.

A module is imported when it is used, so that the command line reads the table at no cost.
"""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from recordings.editing.atomic_output import ExportSummary
    from recordings.reading.recording import Recording
    from recordings.soccer.league.import_log import ImportSummary


class Exporter(NamedTuple):
    """One format that recordings can be exported to."""

    module: str
    """Its module, with a function `export(recording, out)`."""
    suffix: str
    """Replaces `.mcap` in the default name of the output."""
    description: str

    def export(self, recording: "Recording", out: Path) -> "ExportSummary":
        """Write a recording in this format to `out`.

        Raises:
            TouchlineError: `out` cannot be written, or the format requires a package that is missing.
        """
        export: Callable[[Recording, Path], ExportSummary] = import_module(self.module).export
        return export(recording, out)


EXPORTERS = {
    "csv": Exporter("recordings.exchange.csv_files", "-csv", "tables of robots, ball, events, states and commands"),
    "msl-log": Exporter("recordings.soccer.league.export", ".msl.zip", "the log of the league's referee box"),
    "ros2": Exporter("recordings.exchange.ros2", "-ros2", "a ROS 2 bag of clock, transforms, odometry and twists"),
}
"""Format → its exporter."""


def import_log(log: list[Path], out: Path, profile: str | None, team_a: str | None) -> "ImportSummary":
    """Convert the files of a log of the league's referee box to the recording `out`.

    `profile` is the pitch's, recognised if None, `team_a` the name of team A in the log.

    Raises:
        TouchlineError: the log cannot be read, or the recording cannot be written.
    """
    from recordings.soccer.league.import_log import import_log as convert

    return convert(log, out, profile, team_a)
