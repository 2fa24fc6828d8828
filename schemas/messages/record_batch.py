"""Batches of all messages that are to be recorded, byte for byte, those of several ticks in one.

A recorder reads one key. The cost of a message to host and recorder is paid once for several ticks, and what robots and
coaches publish once can be fetched again like everything that the host publishes.
"""

from base64 import b64decode, b64encode
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar

import msgspec
from pydantic import Field

from schemas.message import VERSION, BadMessageError, Message, Part

MAX_KEY = 200
"""Characters of a key."""


class BatchEntry(Part):
    """One message, with what travelled beside it."""

    key: Annotated[str, Field(max_length=MAX_KEY)]
    """Key below the match, `robot/cyan1/command`."""
    message: Any = None
    """The payload where it is JSON: the very bytes that were sent."""
    octets: str | None = None
    """The payload in base64 where it is anything else."""
    sequence: Annotated[int, Field(ge=0)] | None = None
    """Its sender's number on that key; None when it gave none."""
    sent_ns: int = 0
    """The sender's wall time, ns since 1970."""
    sim_ns: int = -1
    """The sender's simulated time in ns, −1 when it knows none."""
    arrived_ns: int = 0
    """When it reached the host, by the host's wall clock, ns since 1970; 0 for the host's own messages."""
    arrived_sim_ns: int = -1
    """The host's simulated time in ns when it took the message in; −1 for the host's own messages."""


class RecordBatch(Message):
    """All messages to be recorded that the host published or took in since the batch before, up to the end of `tick`.

    Recorders read everything from here, and nothing from its senders. A gap in `number` is closed by a question on
    `host/record_batches`.
    """

    max_bytes: ClassVar[int] = 4 * 2**20

    stream: Annotated[int, Field(ge=0)]
    """Wall time at which the host began, ns since 1970: a batch with another one is from another host."""
    number: Annotated[int, Field(ge=0)]
    """Counts this host's batches, from 0."""
    tick: int
    """The last tick that is complete; −1 before the first."""
    sent_ns: int
    """The host's wall time at which it published the batch, ns since 1970."""
    entries: list[BatchEntry]
    """In the order in which the host published or took them in."""


class RecordBatchesRequest(Message):
    """Asks the host for batches that it has published already, from number `first` to number `last`, both included."""

    first: Annotated[int, Field(ge=0)]
    """Number of the first batch that is requested."""
    last: Annotated[int, Field(ge=0)] | None = None
    """None: up to the newest."""
    since_ns: Annotated[int, Field(ge=0)] = 0
    """Batches published before this wall time, ns since 1970, are left out."""


class RecordBatchesReply(Message):
    """Batches that were asked for, in order and without a gap; as many as fit into half a megabyte, but at least one.

    If the last of them is not the last that was asked for, the rest is asked for again.
    """

    max_bytes: ClassVar[int] = 8 * 2**20

    stream: Annotated[int, Field(ge=0)]
    """As in `RecordBatch`."""
    oldest: Annotated[int, Field(ge=0)]
    """Number of the oldest batch that the host keeps and that is not left out; of the next one where there is none.

    What has a smaller number cannot be had any more.
    """
    batches: list[RecordBatch] = Field(default_factory=list)
    """Begins with the larger of `first` and `oldest`; empty where that is not published yet, or beyond `last`."""


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True, gc=False):
    """A `BatchEntry` whose message is kept as the bytes it is."""

    key: Annotated[str, msgspec.Meta(max_length=MAX_KEY)]
    message: msgspec.Raw = msgspec.Raw(b"null")
    octets: str | None = None
    sequence: Annotated[int, msgspec.Meta(ge=0)] | None = None
    sent_ns: int = 0
    sim_ns: int = -1
    arrived_ns: int = 0
    arrived_sim_ns: int = -1

    @property
    def payload(self) -> bytes:
        """The bytes that were sent.

        Raises:
            ValueError: they are no base64.
        """
        return bytes(self.message) if self.octets is None else b64decode(self.octets, validate=True)


_Count = Annotated[int, msgspec.Meta(ge=0)]


class Batch(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """A `RecordBatch` of such entries."""

    version: str
    stream: _Count
    number: _Count
    tick: int
    sent_ns: int
    entries: Sequence[Entry]


class BatchesReply(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """A `RecordBatchesReply` whose batches are kept as the bytes they are."""

    version: str
    stream: _Count
    oldest: _Count
    batches: list[msgspec.Raw] = []


_encode = msgspec.json.Encoder().encode
_decode_batch = msgspec.json.Decoder(Batch).decode
_decode_reply = msgspec.json.Decoder(BatchesReply).decode
_skim = msgspec.json.Decoder(msgspec.Raw).decode


def payload_fields(payload: bytes) -> dict[str, Any]:
    """The fields of an `Entry` that carry a payload from outside, which may be anything."""
    try:
        payload.decode()
        message = _skim(payload)
    except (ValueError, RecursionError):
        return {"octets": b64encode(payload).decode()}
    is_all = len(bytes(message)) == len(payload)
    return {"message": message} if is_all else {"octets": b64encode(payload).decode()}


def write_batch(stream: int, number: int, tick: int, sent_ns: int, entries: Sequence[Entry]) -> bytes:
    """A `RecordBatch` as it is published."""
    return _encode(Batch(VERSION, stream, number, tick, sent_ns, entries))


def read_batch(payload: bytes) -> Batch:
    """A `RecordBatch` as it came.

    Raises:
        BadMessageError: it is none.
    """
    try:
        batch = _decode_batch(payload) if len(payload) <= RecordBatch.max_bytes else None
    except (ValueError, RecursionError) as error:
        RecordBatch.decode(payload)  # says more of another version
        raise BadMessageError(f"RecordBatch: {error}") from None
    if batch is None or batch.version != VERSION:
        RecordBatch.decode(payload)
    assert batch is not None
    return batch


def write_reply(stream: int, oldest: int, batches: Sequence[bytes]) -> bytes:
    """A `RecordBatchesReply` of batches as they were published."""
    return _encode(BatchesReply(VERSION, stream, oldest, [msgspec.Raw(batch) for batch in batches]))


def read_reply(payload: bytes) -> BatchesReply:
    """A `RecordBatchesReply` as it came; its batches are read by `read_batch`.

    Raises:
        BadMessageError: it is none.
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
