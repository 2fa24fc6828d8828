"""Whether messages come from another host than before: a new host counts its messages from 0 again."""

from runtime.bus.contract import ReceivedMessage, Stamp


class HostChangeDetector:
    """The newest stamp of each key."""

    def __init__(self) -> None:
        self._stamps: dict[str, Stamp] = {}

    def is_new_host(self, received: ReceivedMessage) -> bool:
        """Whether this is the first message of another host; then nothing of the host before counts.

        A message that is only delivered again, as happens when a link comes back, is older than the newest one.
        """
        stamp, before = received.stamp, self._stamps.get(received.key)
        if stamp is None or (before is not None and stamp.sent_ns <= before.sent_ns):
            return False
        is_new = before is not None and stamp.sequence <= before.sequence
        if is_new:
            self._stamps.clear()
        self._stamps[received.key] = stamp
        return is_new
