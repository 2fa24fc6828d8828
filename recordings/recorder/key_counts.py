"""What a recorder of keys has counted: the metadata `keys` at the end of its file."""

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from recordings.container.encodings import ENCODING
from recordings.container.mcap_file import McapFile

KEYS = "keys"
"""Name of the metadata record."""


@dataclass(frozen=True, slots=True)
class KeyCounts:
    """The counts of one recorder, or of several."""

    expressions: str
    """The recorded key expressions."""
    lost: dict[str, int]
    """Key → messages that its publishers have numbered and that did not arrive; keys without loss are left out."""
    unwritten: int
    """Messages that had arrived at the end, and for which there was no time."""

    def metadata(self) -> dict[str, str]:
        """The counts as MCAP metadata."""
        return {"keys": self.expressions, "lost": json.dumps(self.lost), "unwritten": str(self.unwritten)}


def was_cut_off(file: McapFile) -> bool:
    """Whether a recorder of keys wrote this file, and did not come to its counts."""
    return _read(file) is None and any(ENCODING in channel.metadata for channel in file.channels.values())


def counts_of(files: Sequence[McapFile]) -> KeyCounts | None:
    """The counts of all files; None if one was cut off, or none is of a recorder of keys."""
    found = [counts for file in files if (counts := _read(file)) is not None]
    if not found or any(was_cut_off(file) for file in files):
        return None
    lost: Counter[str] = Counter()
    for counts in found:
        lost.update(counts.lost)
    expressions = dict.fromkeys(one for counts in found for one in counts.expressions.split())
    return KeyCounts(" ".join(expressions), dict(lost), sum(counts.unwritten for counts in found))


def _read(file: McapFile) -> KeyCounts | None:
    written = file.metadata.get(KEYS, {})
    try:
        lost = {str(key): int(lost) for key, lost in json.loads(written["lost"]).items()}
        return KeyCounts(written["keys"], lost, int(written.get("unwritten", "0")))
    except (LookupError, ValueError, TypeError, AttributeError):
        return None  # another writer may use this name
