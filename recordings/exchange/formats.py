"""The tables of exporters and importers: a new format is a file and a row."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from recordings.exchange import csv_files
from recordings.exchange.outlet import Exported
from recordings.reader import Recording


class Exporter(NamedTuple):
    """One format that a recording can be written in."""

    export: Callable[[Recording, Path], Exported]
    suffix: str
    """In place of `.mcap` in the name of what is written."""
    says: str


EXPORTERS: dict[str, Exporter] = {
    "csv": Exporter(csv_files.export, "-csv", "a folder of tables: robots, ball, events, states, commands"),
}
"""Format → its exporter."""
