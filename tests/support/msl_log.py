"""Small logs of the league, written by hand."""

import json
from pathlib import Path
from typing import Any

from recordings.reading.recording import Recording, open_recording
from recordings.soccer.league.import_log import ImportSummary, import_log

START_MS = 1467540000000


def robot(number: Any = 2, pose: Any = (1.0, -2.0, 0.5), **more: Any) -> dict[str, Any]:
    fields = {"velocity": [0.5, 0.0, 0.0], "intention": "", "batteryLevel": 90.0, "ballEngaged": 0}
    return {"id": number, "pose": pose, "targetPose": pose, **fields, **more}


def record(after_ms: float = 0, robots: Any = None, balls: Any = None, **more: Any) -> dict[str, Any]:
    state = {
        "type": "worldstate",
        "teamName": "Reds",
        "intention": "",
        "robots": [robot()] if robots is None else robots,
        "balls": [{"position": [0.0, 3.0, 0.2], "velocity": [0, 0, 0], "confidence": 0.9}] if balls is None else balls,
        "obstacles": [],
        "ageMs": 0,
    }
    return {"teamName": "Reds", "timestamp": START_MS + after_ms, "gametimeMs": 0, "worldstate": state | more}


class Log:
    """A log's files, written and imported."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "20160703_120000"
        self.folder.mkdir()

    def write(self, letter: str, records: list[Any] | str) -> None:
        text = records if isinstance(records, str) else json.dumps(records)
        (self.folder / f"20160703_120000.{letter}.msl").write_text(text, encoding="utf-8")

    def events(self, *lines: str) -> None:
        (self.folder / "20160703_120000.msl").write_text("\n".join(lines))

    def read(self, **options: Any) -> tuple[ImportSummary, Recording]:
        imported = import_log([self.folder], self.folder.with_suffix(".mcap"), **options)
        return imported, open_recording(imported.out)
