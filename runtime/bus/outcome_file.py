"""The outcome of a match in a file: the host's events and its last state of the game, as it published them.

Who launches a host reads it, and knows the result whatever it, or a recorder, has missed.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

from runtime.bus.contract import ReceivedMessage, Stamp
from runtime.process.whole_file import written_whole
from schemas.messages.record_batch import BatchEntry, RecordBatch
from schemas.topics import EVENT, STATE
from schemas.wire.message import BadMessageError

_TOPICS = {topic.key: topic for topic in (EVENT, STATE)}


def write_outcome(path: Path, messages: Sequence[ReceivedMessage]) -> None:
    """Write events and states, which have stamps, in the form of a record batch.

    Raises:
        OSError: the file cannot be written.
    """
    entries = [BatchEntry.of(one.key, one.payload, *one.stamp) for one in messages if one.stamp is not None]
    with written_whole(path) as draft:
        draft.write_bytes(RecordBatch(stream=0, number=0, tick=-1, sent_ns=0, entries=entries).encode())


def read_outcome(path: Path) -> Iterator[ReceivedMessage]:
    """The messages of an outcome; none if the host has not written one."""
    try:
        entries = RecordBatch.decode(path.read_bytes()).entries
    except (OSError, BadMessageError):
        return
    for entry in entries:
        stamp = Stamp(entry.sequence or 0, entry.sent_ns, entry.sim_ns)
        if entry.key in _TOPICS:
            yield ReceivedMessage(_TOPICS[entry.key], entry.key, entry.payload, stamp)
