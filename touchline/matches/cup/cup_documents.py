"""What the state of a run has on a cup, besides the outcomes of its matches."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from touchline.matches.cup.cup_config import CupConfig
from touchline.matches.engine.store import RunStore

CUP, DIGESTS, CODE_FOLDER, VERSION = "cup", "digests", "code folder", "version"
"""Names of documents."""
RESULT = "result.json"
"""The file of tables, matches, ratings and winner, in the folder of a cup."""


@dataclass(frozen=True, slots=True)
class StoredCup:
    """A cup that has begun."""

    cup: CupConfig
    digests: Mapping[str, str]
    """Team → digest of its files when the cup began."""
    code_folder: Path
    """Where brains and programs were looked for first."""
    version: str
    """The version of the program that began it."""


def stored_cup(store: RunStore) -> StoredCup | None:
    """The cup of a folder; None before it has begun."""
    texts = [store.document(name) for name in (CUP, DIGESTS, CODE_FOLDER, VERSION)]
    cup, digests, code_folder, version = (text or "" for text in texts)
    if not all(texts):
        return None
    return StoredCup(CupConfig.model_validate_json(cup), json.loads(digests), Path(code_folder), version)
