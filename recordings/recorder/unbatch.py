"""Extracts the messages of a host's batches, each as its sender published it, with its log time."""

from functools import lru_cache

from recordings.recorder.latched_messages import LoggedMessage
from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.messages.record_batch import BatchEntry, RecordBatch
from schemas.topic import Party, Topic
from schemas.topics import SIGHT, TOPICS
from schemas.wire.message import BadMessageError

_RECORDED = tuple(topic for topic in TOPICS.values() if topic.recorded or topic is SIGHT)


@lru_cache(1024)
def _topic_of(key: str) -> Topic | None:
    """The topic of a key; None if it is not recorded."""
    return next((topic for topic in _RECORDED if topic.match(key) is not None), None)


class Unbatcher:
    """Extracts the messages of batches, in order.

    The log time of a message is the host's simulated time when it published or received the message; it never runs
    backward.
    """

    def __init__(self, *, sights: bool = False, begins_ns: int = 0) -> None:
        """Without `sights`, sights are skipped. Messages before the log time `begins_ns` are skipped, too."""
        self._sights, self._begins_ns = sights, begins_ns
        self._log_ns = 0

    def messages_of(self, batch: RecordBatch) -> list[LoggedMessage]:
        """The messages of a batch, in order; keys of no recorded topic are skipped.

        Raises:
            BadMessageError: an entry cannot be read.
        """
        found = []
        log_ns, sights = self._log_ns, self._sights
        for entry in batch.entries:
            key, number = entry.key, entry.sequence
            topic = _topic_of(key)
            if topic is None or (topic is SIGHT and not sights):
                continue
            moment = entry.sim_ns if topic.writer is Party.HOST else entry.arrived_sim_ns
            if moment > log_ns:
                log_ns = moment
            if log_ns < self._begins_ns:
                continue
            payload = bytes(entry.message) if entry.octets is None else _octets(entry)
            stamp = Stamp(number, entry.sent_ns, entry.sim_ns) if number is not None else None
            found.append((log_ns, ReceivedMessage(topic, key, payload, stamp, entry.arrived_ns)))
        self._log_ns = log_ns
        return found


def _octets(entry: BatchEntry) -> bytes:
    try:
        return entry.payload
    except ValueError as error:
        raise BadMessageError(f"RecordBatch: octets of {entry.key}: {error}") from None
