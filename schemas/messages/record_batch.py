"""Batches of all messages to be recorded, byte for byte, several ticks in one batch.

A recorder subscribes to one key. The cost of a message to host and recorder is paid once for several ticks, and
messages that robots and coaches publish once can be requested again like the host's.
"""

from base64 import b64decode, b64encode
from typing import Annotated, Any, ClassVar, Self

import msgspec
from msgspec import Meta

from schemas.wire.message import Message
from schemas.wire.part import Part

MAX_KEY = 200
"""Most characters of a key."""
_NULL = msgspec.Raw(b"null")
_skim = msgspec.json.Decoder(msgspec.Raw).decode


class BatchEntry(Part, kw_only=False, omit_defaults=True):
    """One message with its metadata; fields that have their default are omitted. The message stays encoded."""

    key: Annotated[str, Meta(max_length=MAX_KEY)]
    """Key below the match, `robot/cyan1/command`."""
    message: msgspec.Raw = msgspec.field(default_factory=lambda: _NULL)
    """The payload where it is JSON, byte for byte."""
    octets: str | None = None
    """The payload in base64 where it is not JSON; otherwise None."""
    sequence: Annotated[int, Meta(ge=0)] | None = None
    """The sender's sequence number on that key; None where the sender gave none."""
    sent_ns: int = 0
    """The sender's wall time, ns since 1970."""
    sim_ns: int = -1
    """The sender's simulated time in ns, −1 where it has none."""
    arrived_ns: int = 0
    """Wall time at which it reached the host, by the host's clock, ns since 1970; 0 for the host's own messages."""
    arrived_sim_ns: int = -1
    """The host's simulated time in ns when it received the message; −1 for the host's own messages."""

    @classmethod
    def of(cls, key: str, payload: bytes, *numbers: Any) -> Self:
        """The entry of a payload, which may be any bytes; `numbers` are the fields from `sequence` on."""
        try:
            payload.decode()
            message = _skim(payload)
            is_whole = len(memoryview(message)) == len(payload)
        except (ValueError, RecursionError):
            is_whole = False
        if is_whole:
            return cls(key, message, None, *numbers)
        return cls(key, _NULL, b64encode(payload).decode(), *numbers)

    @property
    def payload(self) -> bytes:
        """The bytes that were sent.

        Raises:
            ValueError: `octets` is not base64.
        """
        return bytes(self.message) if self.octets is None else b64decode(self.octets, validate=True)


class RecordBatch(Message):
    """All messages to be recorded that the host published or received since the last batch, up to the end of `tick`.

    Recorders read all messages from here, and none from their senders. Missing numbers are requested on
    `host/record_batches`.
    """

    max_bytes: ClassVar[int] = 4 * 2**20

    stream: Annotated[int, Meta(ge=0)]
    """Wall time at which the host began, ns since 1970, which distinguishes hosts."""
    number: Annotated[int, Meta(ge=0)]
    """Sequence number of the batch, from 0."""
    tick: int
    """The last complete tick; −1 before the first."""
    sent_ns: int
    """The host's wall time when it published the batch, ns since 1970."""
    entries: list[BatchEntry]
    """The messages, in the order in which the host published or received them."""


class RecordBatchesRequest(Message):
    """A request for published batches, from number `first` to number `last`, both included."""

    first: Annotated[int, Meta(ge=0)]
    """Number of the first requested batch."""
    last: Annotated[int, Meta(ge=0)] | None = None
    """Number of the last requested batch; None for the newest."""
    since_ns: Annotated[int, Meta(ge=0)] = 0
    """Batches published before this wall time, ns since 1970, are left out."""


class RecordBatchesReply(Message):
    """The requested batches, in order and without a gap: as many as fit into half a megabyte, and at least one.

    Where it ends before the last requested batch, the rest is requested again.
    """

    max_bytes: ClassVar[int] = 8 * 2**20

    stream: Annotated[int, Meta(ge=0)]
    """The host's `stream`, as in `RecordBatch`."""
    oldest: Annotated[int, Meta(ge=0)]
    """Number of the oldest available batch, without those before `since_ns`; of the next batch where there is none.

    Batches with smaller numbers are lost.
    """
    batches: list[msgspec.Raw] = []
    """The batches from the larger of `first` and `oldest` on; empty where that is unpublished or beyond `last`.

    Each is a `RecordBatch` that stays encoded: one that cannot be read leaves the others readable.
    """
