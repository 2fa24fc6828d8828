"""What every export reports: how much was written, and how much of the recording could not be."""

from collections.abc import Callable
from pathlib import Path

import pytest

from recordings.editing.atomic_output import ExportSummary
from recordings.exchange import csv_files, ros2
from recordings.reading.recording import Recording
from recordings.soccer.league import export as msl
from support.recorder_rig import RecorderRig

EXPORTS: dict[str, Callable[[Recording, Path], ExportSummary]] = {
    "csv": csv_files.export,
    "msl": msl.export,
    "ros2": ros2.export,
}


@pytest.mark.parametrize("kind", EXPORTS)
def test_messages_that_cannot_be_decoded_are_counted_by_their_key(kind: str, rig: RecorderRig, tmp_path: Path) -> None:
    rig.play(range(5))
    rig.host.writers["world"].put_payload(b"no world")
    rig.play(range(5, 10))
    rig.leave()
    summary = EXPORTS[kind](rig.read(), tmp_path / "out.mcap")
    assert summary.out == tmp_path / "out.mcap" and summary.out.exists()
    assert sum(summary.written.values()) > 0
    assert summary.unreadable == {"world": 1}
