"""The outcomes of a study's matches on disk: an SQLite file that survives a crash between any two matches."""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from schemas.errors import TouchlineError
from touchline.experiment.match_outcome import MatchOutcome, from_json, to_json


class OutcomeStore:
    """One writer at a time; see `open_store`."""

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._connection = connection

    def outcomes(self) -> dict[str, MatchOutcome]:
        """Identity of a match → its outcome."""
        rows = self._connection.execute("SELECT identity, outcome FROM outcomes").fetchall()
        return {identity: from_json(outcome) for identity, outcome in rows}

    def add(self, outcome: MatchOutcome) -> None:
        """Store an outcome durably."""
        row = (outcome.identity, to_json(outcome))
        with self._connection:
            self._connection.execute("INSERT OR REPLACE INTO outcomes VALUES (?, ?)", row)


@contextmanager
def open_store(path: Path) -> Iterator[OutcomeStore]:
    """The store of a file, which is made if there is none, locked against other writers until the end.

    Raises:
        TouchlineError: another process writes it, or it is no such file.
    """
    connection = sqlite3.connect(path, timeout=0.2)
    try:
        connection.execute("PRAGMA locking_mode = EXCLUSIVE")
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = FULL")
        with connection:
            connection.execute("CREATE TABLE IF NOT EXISTS outcomes (identity TEXT PRIMARY KEY, outcome TEXT NOT NULL)")
            connection.execute("BEGIN EXCLUSIVE")
    except sqlite3.OperationalError as error:
        connection.close()
        raise TouchlineError(f"{path}: {error}; is another process running the same study?") from None
    except sqlite3.DatabaseError as error:
        connection.close()
        raise TouchlineError(f"{path}: {error}; remove the file to begin anew") from None
    try:
        yield OutcomeStore(connection)
    finally:
        connection.close()
