"""What the state of a run has on a cup, besides the outcomes of its matches."""

from pathlib import Path

from schemas.wire.message import Part
from touchline.matches.cup.cup_config import CupConfig
from touchline.matches.engine.store import RunStore

_CUP = "cup"
"""Name of the document."""
RESULT = "result.json"
"""The file of tables, matches, ratings and winner, in the folder of a cup."""


class StoredCup(Part):
    """A cup that has begun."""

    cup: CupConfig
    digests: dict[str, str]
    """Team → digest of its files when the cup began."""
    code_folder: Path
    """Where brains and programs were looked for first."""
    version: str
    """The version of the program that began it."""


def stored_cup(store: RunStore) -> StoredCup | None:
    """The cup of a folder; None before it has begun."""
    text = store.document(_CUP)
    return StoredCup.model_validate_json(text) if text is not None else None


def store_cup(store: RunStore, cup: StoredCup) -> None:
    """Store a cup that begins."""
    store.set_document(_CUP, cup.model_dump_json())
