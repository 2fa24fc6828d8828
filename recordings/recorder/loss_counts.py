"""The loss counts of a recording: messages received and lost on each key, in all files and in the current one."""

from collections.abc import Iterable

from recordings.container.manifest import KeyCount
from recordings.recorder.latched_messages import LoggedMessage
from recordings.recorder.sequence_tracker import SequenceTracker
from schemas.natural_order import natural_order


class LossCounts:
    """The trackers of all keys, and their counts at the beginning of the current file."""

    def __init__(self) -> None:
        self._trackers: dict[str, SequenceTracker] = {}
        self._before: dict[str, KeyCount] = {}

    def add(self, batch: Iterable[LoggedMessage]) -> None:
        """Add messages that are written."""
        trackers = self._trackers
        for _, received in batch:
            tracker = trackers.get(received.key)
            if tracker is None:
                tracker = trackers[received.key] = SequenceTracker()
            tracker.add(received.stamp, len(received.payload))

    def for_this_file(self) -> dict[str, KeyCount]:
        """Key → its counts since the beginning of the current file, sorted."""
        counts = {}
        for key, tracker in self._sorted():
            count = tracker.count().since(self._before.get(key, KeyCount()))
            if count != KeyCount():
                counts[key] = count
        return counts

    def forget_missed_before_start(self) -> None:
        """Do not count what was sent before the first message: it is in files that are read no more."""
        for tracker in self._trackers.values():
            tracker.missed_before_start = 0

    def start_file(self) -> None:
        """Begin another file."""
        self._before = {key: tracker.count() for key, tracker in self._trackers.items()}

    @property
    def losses(self) -> dict[str, int]:
        """Key → messages lost in all files; keys without loss are left out."""
        return {key: tracker.lost for key, tracker in self._sorted() if tracker.lost}

    def _sorted(self) -> list[tuple[str, SequenceTracker]]:
        return sorted(self._trackers.items(), key=lambda item: natural_order(item[0]))
