"""The minutes of a match: everything that is recorded of it, byte for byte, the messages of several ticks in one.

A recorder listens to one key. What a message costs host and recorder is paid once for some ticks, and what robots and
coaches say once and forget can be fetched again like all that the host says.
"""

from base64 import b64decode, b64encode
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar

import msgspec
from pydantic import Field

from schemas.message import VERSION, BadMessageError, Message, Part

MAX_KEY = 200
"""Characters of a key."""


class MinutesEntry(Part):
    """One message, with what travelled beside it."""

    key: Annotated[str, Field(max_length=MAX_KEY)]
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


class Minutes(Message):
    """All that is recorded of what the host said and took in since the minutes before, up to the end of `tick`.

    Recorders take everything but sights from here, and nothing from its senders: what a host says can be fetched
    again.
    """

    max_bytes: ClassVar[int] = 4 * 2**20

    tick: int
    entries: list[MinutesEntry]


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True, gc=False):
    """A `MinutesEntry` whose message is kept as the bytes it is."""

    key: Annotated[str, msgspec.Meta(max_length=MAX_KEY)]
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


class _Page(msgspec.Struct, frozen=True, forbid_unknown_fields=True, gc=False):
    """`Minutes`, of such entries."""

    version: str
    tick: int
    entries: Sequence[Entry]


_encode = msgspec.json.Encoder().encode
_decode = msgspec.json.Decoder(_Page).decode
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


def write_minutes(tick: int, entries: Sequence[Entry]) -> bytes:
    """`Minutes` as they are sent."""
    return _encode(_Page(VERSION, tick, entries))


def read_minutes(payload: bytes) -> Sequence[Entry]:
    """The entries of `Minutes`.

    Raises:
        BadMessageError: they are no minutes.
    """
    try:
        page = _decode(payload) if len(payload) <= Minutes.max_bytes else None
    except (ValueError, RecursionError) as error:
        Minutes.decode(payload)  # says more of another version
        raise BadMessageError(f"Minutes: {error}") from None
    if page is None or page.version != VERSION:
        Minutes.decode(payload)
    assert page is not None
    return page.entries
