"""The result of a match for its page: written by the process that launched the match, read by the page's server."""

from pathlib import Path

from coach_gateway.web.pages.protocol import ResultUpdate
from runtime.process.whole_file import written_whole
from schemas.wire.part_faults import decoded

FILE = "result.json"
STATISTICS = "statistics.html"
"""The replay and the statistics as one page, in the folder of the result."""
STATISTICS_ADDRESS = f"result/{STATISTICS}"
"""The address of the statistics, below the page's own."""


def write_result(folder: Path, result: ResultUpdate) -> None:
    """Write the result into a folder atomically: a reader sees the new one or the previous one, whole."""
    folder.mkdir(parents=True, exist_ok=True)
    with written_whole(folder / FILE, private=True) as draft:
        draft.write_text(result.json(), "utf-8")


class ResultReader:
    """Notices a result that is written, and one that replaces it."""

    def __init__(self, folder: Path | None) -> None:
        self._file = folder / FILE if folder is not None else None
        self._read_at: int | None = None
        self.result: ResultUpdate | None = None
        """The newest result; None before there is one."""

    def update(self) -> bool:
        """Look for a result; returns whether there is a new one."""
        if self._file is None:
            return False
        try:
            written_at = self._file.stat().st_mtime_ns
            if written_at == self._read_at:
                return False
            self.result = decoded(ResultUpdate, self._file.read_bytes())
        except FileNotFoundError:
            return False
        self._read_at = written_at
        return True
