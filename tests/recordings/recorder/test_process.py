"""What a recorder writes to the terminal when it ends."""

from pathlib import Path

import pytest

from recordings.container.manifest import EndReason, Result
from recordings.recorder.process import closing_line
from recordings.recorder.recording_summary import RecordingSummary

RESULT = Result(ended=EndReason.FULL_TIME, finished="2026-01-01", tick=199, messages=1203, lost=2)
COUNTS = "1203 messages, 200 ticks, 2 lost, 4096 bytes, ended by full_time"


@pytest.mark.parametrize(
    ("files", "line"),
    [
        (["match.mcap"], f"match.mcap: {COUNTS}"),
        (["match.0001.mcap", "match.0002.mcap", "match.0003.mcap"], f"match.0001.mcap and 2 more: {COUNTS}"),
    ],
)
def test_the_line_at_the_end_counts_files_messages_ticks_and_losses(files: list[str], line: str) -> None:
    assert closing_line(RecordingSummary([Path(file) for file in files], 4096, RESULT)) == line
