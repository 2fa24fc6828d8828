"""Batches of all messages to be recorded, byte for byte, several ticks in one batch.

A recorder subscribes to one key. The cost of a message to host and recorder is paid once for several ticks, and
messages that robots and coaches publish once can be requested again like the host's.
"""

from base64 import b64decode, b64encode
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar

import msgspec
from msgspec import Meta

from schemas.wire.message import VERSION, BadMessageError, Message
from schemas.wire.part import Part

MAX_KEY = 200
"""Most characters of a key."""


class BatchEntry(Part):
    """One message with its metadata."""

    key: Annotated[str, Meta(max_length=MAX_KEY)]
    """Key below the match, `robot/cyan1/command`."""
    message: Any = None
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
    batches: list[RecordBatch] = []
    """The batches from the larger of `first` and `oldest` on; empty where that is unpublished or beyond `last`."""


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True, gc=False):
    """A `BatchEntry` whose message stays encoded."""

    key: Annotated[str, Meta(max_length=MAX_KEY)]
    message: msgspec.Raw = msgspec.Raw(b"null")
    octets: str | None = None
    sequence: Annotated[int, Meta(ge=0)] | None = None
    sent_ns: int = 0
    sim_ns: int = -1
    arrived_ns: int = 0
    arrived_sim_ns: int = -1

    @property
    def payload(self) -> bytes:
        """The bytes that were sent.

        Raises:
            ValueError: `octets` is not base64.
        """
        return bytes(self.message) if self.octets is None else b64decode(self.octets, validate=True)


_Count = Annotated[int, Meta(ge=0)]


class Batch(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """A `RecordBatch` of `Entry`."""

    version: str
    stream: _Count
    number: _Count
    tick: int
    sent_ns: int
    entries: Sequence[Entry]


class BatchesReply(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """A `RecordBatchesReply` whose batches stay encoded."""

    version: str
    stream: _Count
    oldest: _Count
    batches: list[msgspec.Raw] = []


_encode = msgspec.json.Encoder().encode
_decode_batch = msgspec.json.Decoder(Batch).decode
_decode_reply = msgspec.json.Decoder(BatchesReply).decode
_skim = msgspec.json.Decoder(msgspec.Raw).decode


def payload_fields(payload: bytes) -> dict[str, Any]:
    """The fields of an `Entry` for a payload, which may be any bytes."""
    try:
        payload.decode()
        message = _skim(payload)
    except (ValueError, RecursionError):
        return {"octets": b64encode(payload).decode()}
    is_all = len(bytes(message)) == len(payload)
    return {"message": message} if is_all else {"octets": b64encode(payload).decode()}


def write_batch(stream: int, number: int, tick: int, sent_ns: int, entries: Sequence[Entry]) -> bytes:
    """An encoded `RecordBatch`."""
    return _encode(Batch(VERSION, stream, number, tick, sent_ns, entries))


def read_batch(payload: bytes) -> Batch:
    """The batch in a payload.

    Raises:
        BadMessageError: the payload is not a `RecordBatch`.
    """
    try:
        batch = _decode_batch(payload) if len(payload) <= RecordBatch.max_bytes else None
    except (ValueError, RecursionError) as error:
        RecordBatch.decode(payload)  # names another version
        raise BadMessageError(f"RecordBatch: {error}") from None
    if batch is None or batch.version != VERSION:
        RecordBatch.decode(payload)
    assert batch is not None
    return batch


def write_reply(stream: int, oldest: int, batches: Sequence[bytes | memoryview]) -> bytes:
    """An encoded `RecordBatchesReply` of encoded batches."""
    return _encode(BatchesReply(VERSION, stream, oldest, [msgspec.Raw(batch) for batch in batches]))


def read_reply(payload: bytes) -> BatchesReply:
    """The reply in a payload; `read_batch` reads its batches.

    Raises:
        BadMessageError: the payload is not a `RecordBatchesReply`.
    """
    try:
        reply = _decode_reply(payload) if len(payload) <= RecordBatchesReply.max_bytes else None
    except (ValueError, RecursionError) as error:
        RecordBatchesReply.decode(payload)
        raise BadMessageError(f"RecordBatchesReply: {error}") from None
    if reply is None or reply.version != VERSION:
        RecordBatchesReply.decode(payload)
    assert reply is not None
    return reply
