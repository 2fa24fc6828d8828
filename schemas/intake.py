"""What reached the host from others, handed on for the record: commands and orders, byte for byte."""

from base64 import b64decode, b64encode
from typing import Annotated, Any, ClassVar

from pydantic import Field

from schemas.message import Message, Part

MAX_KEY = 200
"""Characters of a key."""


class IntakeEntry(Part):
    """One payload, with what travelled beside it."""

    key: Annotated[str, Field(max_length=MAX_KEY)]
    """Key below the match, `robot/cyan1/command`."""
    text: str | None = None
    """The payload, where it is UTF-8."""
    octets: str | None = None
    """The payload in base64, where it is not."""
    sequence: Annotated[int, Field(ge=0)] | None = None
    """Its sender's number on that key; nothing when it gave none."""
    sent_ns: int = 0
    """The sender's wall time, ns since 1970."""
    sim_ns: int = -1
    """The sender's simulated time in ns, −1 when it knows none."""
    arrived_ns: int = 0
    """When it reached the host, by the host's wall clock, ns since 1970; 0 when that is not known."""

    @property
    def payload(self) -> bytes:
        """The bytes that came."""
        return self.text.encode() if self.text is not None else b64decode(self.octets or "")


class Intake(Message):
    """Everything that the host took in of one tick, in the order it came.

    Recorders take commands and orders from here and not from their senders: what the host says can be fetched again.
    """

    max_bytes: ClassVar[int] = 4 * 2**20

    tick: int
    entries: list[IntakeEntry]


def payload_field(payload: bytes) -> dict[str, Any]:
    """The field of an entry that carries these bytes."""
    try:
        return {"text": payload.decode()}
    except UnicodeDecodeError:
        return {"octets": b64encode(payload).decode()}
