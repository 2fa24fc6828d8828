"""The state of a run: its plan and the outcomes so far, in one SQLite file that survives a power cut."""

import fcntl
import os
import sqlite3
from contextlib import suppress
from pathlib import Path

from msgspec import DecodeError

from schemas.errors import TouchlineError
from schemas.wire.part import encode
from touchline.matches.engine.outcome import FailureKind, Outcome, from_json

FILE = "run.sqlite"
"""The file of a run's state, in its folder."""
_LOCK = "run.lock"
_SCHEMA = """
CREATE TABLE IF NOT EXISTS documents (name TEXT PRIMARY KEY, content TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS outcomes (identity TEXT PRIMARY KEY, content BLOB NOT NULL) WITHOUT ROWID;
"""


class RunStore:
    """The state of one run; one process at a time writes it, any number read."""

    def __init__(self, folder: Path, *, read_only: bool = False) -> None:
        """Open the state in a folder; a new one is made, unless it is only to be read.

        Raises:
            TouchlineError: there is no run in the folder, another process is at it, or it cannot be written.
        """
        self.folder = folder
        path = folder / FILE
        if read_only and not path.exists():
            raise TouchlineError(f"{folder}: has no {FILE}; give the folder of a run")
        self._lock: int | None = None
        try:
            if read_only:
                self._database = sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)
                self._database.execute("SELECT 1 FROM outcomes, documents LIMIT 1")
                return
            folder.mkdir(parents=True, exist_ok=True)
            self._lock = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT, 0o644)
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            self._database = sqlite3.connect(path, isolation_level=None)
            self._database.execute("PRAGMA journal_mode = WAL")
            self._database.execute("PRAGMA synchronous = FULL")
            self._database.executescript(_SCHEMA)
        except BlockingIOError:
            self.close()
            raise TouchlineError(f"{folder}: another process plays this run; wait for it, or end it") from None
        except (OSError, sqlite3.Error) as error:
            self.close()
            raise TouchlineError(f"{folder}: cannot be used for a run ({error}); give another folder") from None

    def document(self, name: str) -> str | None:
        """A text of the run, such as its plan; None if there is none."""
        row = self._database.execute("SELECT content FROM documents WHERE name = ?", (name,)).fetchone()
        return row[0] if row is not None else None

    def set_document(self, name: str, content: str) -> None:
        """Store a text of the run."""
        self._database.execute("INSERT OR REPLACE INTO documents VALUES (?, ?)", (name, content))

    def outcomes(self) -> dict[str, Outcome]:
        """Identity → outcome of all matches that have ended.

        Raises:
            TouchlineError: the state is damaged.
        """
        try:
            rows = self._database.execute("SELECT identity, content FROM outcomes ORDER BY identity")
            return {identity: from_json(content) for identity, content in rows}
        except (sqlite3.Error, DecodeError) as error:
            raise TouchlineError(f"{self.folder / FILE}: damaged ({error}); use another copy") from None

    def add(self, outcome: Outcome) -> None:
        """Store an outcome; it is on disk when this returns."""
        self._database.execute("INSERT OR REPLACE INTO outcomes VALUES (?, ?)", (outcome.identity, encode(outcome)))

    def forget_lost(self) -> None:
        """Remove the outcomes of matches whose worker was lost, so that they are played again."""
        kind = "json_extract(CAST(content AS TEXT), '$.kind')"
        self._database.execute(f"DELETE FROM outcomes WHERE {kind} = ?", (FailureKind.WORKER,))

    def forget_all(self) -> None:
        """Remove all outcomes and texts, for a run that begins anew."""
        self._database.executescript("DELETE FROM outcomes; DELETE FROM documents;")

    def close(self) -> None:
        """Close the file, which those who cannot write its folder may read then, and let another process write it."""
        if hasattr(self, "_database"):
            if self._lock is not None:
                with suppress(sqlite3.Error):  # somebody reads it, or it is none
                    self._database.execute("PRAGMA journal_mode = DELETE")
            self._database.close()
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None
