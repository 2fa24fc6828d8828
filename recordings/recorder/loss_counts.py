"""The loss counts of a recording: messages received and lost on each key."""

from collections.abc import Iterable

from recordings.container.manifest import KeyCount
from recordings.recorder.latched_messages import LoggedMessage
from recordings.recorder.sequence_tracker import SequenceTracker
from schemas.natural_order import natural_order


class LossCounts:
    """The trackers of all keys."""

    def __init__(self) -> None:
        self._trackers: dict[str, SequenceTracker] = {}

    def add(self, batch: Iterable[LoggedMessage]) -> None:
        """Add messages that are written."""
        trackers = self._trackers
        for _, received in batch:
            tracker = trackers.get(received.key)
            if tracker is None:
                tracker = trackers[received.key] = SequenceTracker()
            tracker.add(received.stamp, len(received.payload))

    def counts(self) -> dict[str, KeyCount]:
        """Key → its counts, sorted."""
        return {key: tracker.count() for key, tracker in self._sorted()}

    @property
    def losses(self) -> dict[str, int]:
        """Key → messages lost; keys without loss are left out."""
        return {key: tracker.lost for key, tracker in self._sorted() if tracker.lost}

    def _sorted(self) -> list[tuple[str, SequenceTracker]]:
        return sorted(self._trackers.items(), key=lambda item: natural_order(item[0]))
