"""The account of a recording: what came on every key, what was lost, and how much of it stands in this file."""

from collections.abc import Iterable

from recordings.manifest import KeyCount
from recordings.sequences import KeyLedger
from recordings.standing import Logged


class Account:
    """The ledgers of all keys, and where they stood when this file began."""

    def __init__(self) -> None:
        self._ledgers: dict[str, KeyLedger] = {}
        self._before: dict[str, KeyCount] = {}

    def enter(self, batch: Iterable[Logged], *, left_out: bool = False) -> None:
        """Messages are written, or, with `left_out`, passed over because the recorder is paused."""
        ledgers = self._ledgers
        for _, received in batch:
            ledger = ledgers.get(received.key)
            if ledger is None:
                ledger = ledgers[received.key] = KeyLedger()
            ledger.enter(received.stamp, len(received.payload), left_out)

    def of_this_file(self) -> dict[str, KeyCount]:
        """Key → its counts since this file began, sorted."""
        counts = {}
        for key, ledger in sorted(self._ledgers.items()):
            count = ledger.count().since(self._before.get(key, KeyCount()))
            if count != KeyCount():
                counts[key] = count
        return counts

    def next_file(self) -> None:
        """Another file begins."""
        self._before = {key: ledger.count() for key, ledger in self._ledgers.items()}

    @property
    def losses(self) -> dict[str, int]:
        """Key → messages lost in all files; the keys without loss are left out."""
        return {key: ledger.lost for key, ledger in sorted(self._ledgers.items()) if ledger.lost}
