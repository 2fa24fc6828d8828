"""Who writes what is heard: another host counts its messages from their beginning."""

from schemas.bus.contract import ReceivedMessage, Stamp


class HostChangeDetector:
    """The newest stamp of each key."""

    def __init__(self) -> None:
        self._stamps: dict[str, Stamp] = {}

    def is_new_host(self, received: ReceivedMessage) -> bool:
        """Whether this is the first that is heard of another host; then nothing of the one before counts.

        What is only told again, as it is when a link comes back, is older than what was heard last.
        """
        stamp, before = received.stamp, self._stamps.get(received.key)
        if stamp is None or (before is not None and stamp.sent_ns <= before.sent_ns):
            return False
        is_new = before is not None and stamp.sequence <= before.sequence
        if is_new:
            self._stamps.clear()
        self._stamps[received.key] = stamp
        return is_new
