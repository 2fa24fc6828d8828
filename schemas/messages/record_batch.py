"""Batches of messages to be recorded: everything that a recording holds, byte for byte, several ticks in one message.

A recorder listens to one key. What a message costs host and recorder is paid once for some ticks, and what robots and
coaches say once and forget can be fetched again like all that the host says.
"""

from base64 import b64decode, b64encode
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar

import msgspec
from pydantic import Field

from schemas.message import VERSION, BadMessageError, Message, Part

MAX_KEY_LENGTH = 200
"""Characters of a key."""


class BatchEntry(Part):
    """One message, with what travelled beside it."""

    key: Annotated[str, Field(max_length=MAX_KEY_LENGTH)]
    """Key below the match, `robot/cyan1/command`."""
    message: Any = None
    """The payload where it is JSON: the very bytes that were sent."""
    octets: str | None = None
    """The payload in base64 where it is anything else."""
    sequence: Annotated[int, Field(ge=0)] | None = None
    """Its sender's number on that key; nothing when it gave none."""
    sent_ns: int = 0
    """The sender's wall time, ns since 1970."""
    sim_ns: int = -1
    """The sender's simulated time in ns, −1 when it knows none."""
    arrived_ns: int = 0
    """When it reached the host, by the host's wall clock, ns since 1970; 0 for what the host itself says."""


class RecordBatch(Message):
    """All that is recorded of what the host said and took in since the batch before, up to the end of `tick`.

    Recorders take everything but sights from here, and nothing from its senders: what a host says can be fetched
    again.
    """

    max_bytes: ClassVar[int] = 4 * 2**20

    tick: int
    """The last tick of the batch."""
    entries: list[BatchEntry]
    """The messages, in the order in which the host published or received them."""


class RawEntry(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True, gc=False):
    """A `BatchEntry` whose message is kept as the bytes it is."""

    key: Annotated[str, msgspec.Meta(max_length=MAX_KEY_LENGTH)]
    message: msgspec.Raw = msgspec.Raw(b"null")
    octets: str | None = None
    sequence: Annotated[int, msgspec.Meta(ge=0)] | None = None
    sent_ns: int = 0
    sim_ns: int = -1
    arrived_ns: int = 0

    @property
    def payload(self) -> bytes:
        """The bytes that were sent.

        Raises:
            ValueError: they are no base64.
        """
        return bytes(self.message) if self.octets is None else b64decode(self.octets, validate=True)


class _RawBatch(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """A `RecordBatch` of such entries."""

    version: str
    tick: int
    entries: Sequence[RawEntry]


_encode = msgspec.json.Encoder().encode
_decode = msgspec.json.Decoder(_RawBatch).decode
_skim = msgspec.json.Decoder(msgspec.Raw).decode


def payload_fields(payload: bytes) -> dict[str, Any]:
    """The fields of an `RawEntry` that carry a payload from outside, which may be anything."""
    try:
        payload.decode()
        message = _skim(payload)
    except (ValueError, RecursionError):
        return {"octets": b64encode(payload).decode()}
    is_all = len(bytes(message)) == len(payload)
    return {"message": message} if is_all else {"octets": b64encode(payload).decode()}


def encode_batch(tick: int, entries: Sequence[RawEntry]) -> bytes:
    """A `RecordBatch` as it is sent."""
    return _encode(_RawBatch(VERSION, tick, entries))


def decode_batch(payload: bytes) -> Sequence[RawEntry]:
    """The entries of a `RecordBatch`.

    Raises:
        BadMessageError: the payload is no batch.
    """
    try:
        batch = _decode(payload) if len(payload) <= RecordBatch.max_bytes else None
    except (ValueError, RecursionError) as error:
        RecordBatch.decode(payload)  # says more of another version
        raise BadMessageError(f"RecordBatch: {error}") from None
    if batch is None or batch.version != VERSION:
        RecordBatch.decode(payload)
    assert batch is not None
    return batch.entries
