"""The state of a cup in its folder: an SQLite database with one writer, which stores each outcome at once."""

import fcntl
import sqlite3
from pathlib import Path
from typing import TextIO

from schemas.errors import TouchlineError
from touchline.tournament.cup_config import CupConfig
from touchline.tournament.playing.outcome import FailureKind, Outcome

DATABASE = "cup.sqlite"
_TABLES = """
CREATE TABLE IF NOT EXISTS facts (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS digests (team TEXT PRIMARY KEY, digest TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS outcomes (match TEXT PRIMARY KEY, identity TEXT NOT NULL, outcome TEXT NOT NULL);
"""


class CupStore:
    """The database of one cup; to be closed."""

    def __init__(self, folder: Path, *, writes: bool) -> None:
        """With `writes` the folder is made, and locked until the store is closed.

        Raises:
            TouchlineError: there is no cup in the folder, or another process plays it.
        """
        path = folder / DATABASE
        self._lock: TextIO | None = None
        if writes:
            folder.mkdir(parents=True, exist_ok=True)
            self._lock = (folder / "lock").open("w")
            try:
                fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                self._lock.close()
                raise TouchlineError(f"{folder}: another process plays this cup; wait for it, or end it") from None
        elif not path.exists():
            raise TouchlineError(f"{folder}: has no {DATABASE}; give the folder of a cup")
        self._database = sqlite3.connect(path)
        if writes:
            self._database.execute("PRAGMA journal_mode=WAL")
            self._database.execute("PRAGMA synchronous=FULL")
            self._database.executescript(_TABLES)

    def close(self) -> None:
        """Close the database and free the folder."""
        self._database.close()
        if self._lock is not None:
            self._lock.close()

    def begin(self, cup: CupConfig, digests: dict[str, str], version: str) -> None:
        """Store what the cup is, before its first match."""
        with self._database:
            facts = {"cup": cup.model_dump_json(), "version": version}
            self._database.executemany("INSERT INTO facts VALUES (?, ?)", facts.items())
            self._database.executemany("INSERT INTO digests VALUES (?, ?)", digests.items())

    @property
    def cup(self) -> CupConfig | None:
        """The cup of the folder; None before it has begun."""
        row = self._database.execute("SELECT value FROM facts WHERE key = 'cup'").fetchone()
        return CupConfig.model_validate_json(row[0]) if row is not None else None

    @property
    def version(self) -> str:
        """The version of the program that began the cup."""
        row = self._database.execute("SELECT value FROM facts WHERE key = 'version'").fetchone()
        return str(row[0]) if row is not None else ""

    @property
    def digests(self) -> dict[str, str]:
        """Team → digest of its files."""
        return dict(self._database.execute("SELECT team, digest FROM digests"))

    @property
    def outcomes(self) -> dict[str, tuple[str, Outcome]]:
        """Name of a match → its identity and outcome."""
        rows = self._database.execute("SELECT match, identity, outcome FROM outcomes")
        return {match: (identity, Outcome.from_json(text)) for match, identity, text in rows}

    def add(self, match: str, identity: str, outcome: Outcome) -> None:
        """Store how a match ended."""
        with self._database:
            self._database.execute(
                "INSERT OR REPLACE INTO outcomes VALUES (?, ?, ?)", (match, identity, outcome.to_json())
            )

    def forget_not_played(self) -> None:
        """Forget the matches that failed through the fault of neither team, so that they are played again."""
        for match, (_, outcome) in self.outcomes.items():
            if outcome.failure is FailureKind.WORKER:
                with self._database:
                    self._database.execute("DELETE FROM outcomes WHERE match = ?", (match,))
