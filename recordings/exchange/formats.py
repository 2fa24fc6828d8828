"""The tables of exporters and importers: a new format is a module and a row."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from recordings.exchange import csv_files, ros2
from recordings.exchange.atomic_output import ExportSummary
from recordings.exchange.msl import export as msl_log
from recordings.exchange.msl.import_log import ImportSummary, import_log
from recordings.exchange.protobuf import export as protobuf
from recordings.reading.recording import Recording


class Exporter(NamedTuple):
    """One format that recordings can be exported to."""

    export: Callable[[Recording, Path], ExportSummary]
    suffix: str
    """Replaces `.mcap` in the default name of the output."""
    description: str


EXPORTERS: dict[str, Exporter] = {
    "csv": Exporter(csv_files.export, "-csv", "a folder of tables: robots, ball, events, states, commands"),
    "msl-log": Exporter(msl_log.export, ".msl.zip", "the log of the league's referee box, in its own axes"),
    "protobuf": Exporter(protobuf.export, "-protobuf.mcap", "MCAP with typed messages"),
    "ros2": Exporter(ros2.export, "-ros2", "a ROS 2 bag: clock, transforms, odometry and twists"),
}
"""Format → its exporter."""

IMPORTERS: dict[str, Callable[[list[Path], Path, str | None, str | None], ImportSummary]] = {"msl-log": import_log}
"""Format → its importer, called with files of the log, the recording to write, profile of the pitch, name of team A."""
