"""A whole message: a part with the version of the protocol, read from a payload with one sentence for a fault."""

import re
from collections.abc import Callable
from typing import Annotated, Any, ClassVar, Self

import msgspec
from msgspec import Meta
from pydantic import StringConstraints

from schemas.wire.part import Part, decoder, encode
from schemas.wire.part_faults import fault_of_payload

VERSION = "2.0"
"""Version of the protocol that this package implements, "major.minor"."""
Name = Annotated[
    str,
    StringConstraints(pattern=r"^[a-z][a-z0-9_]*$", max_length=32),
    Meta(
        pattern=r"^[a-z][a-z0-9_]*\Z",  # Python's `$` also stands before a last line break
        max_length=32,
        description="lower-case letters, digits and _, a letter first, at most 32 characters",
    ),
]
"""A key chunk: the name of a robot, a match or a process."""
_NAME = re.compile(r"[a-z][a-z0-9_]{0,31}")
PRINTABLE = r"^[^\x00-\x1f\x7f-\x9f]*\Z"
"""Pattern of one line without control characters, which a terminal would obey."""
Source = Annotated[
    str,
    Meta(pattern=PRINTABLE, max_length=80, description="one line of at most 80 plain characters"),
]
"""Name of the sender of a request, for display."""
ShortText = Annotated[str, Meta(max_length=80)]


def is_name(text: str) -> bool:
    """Whether a text is a `Name`."""
    return _NAME.fullmatch(text) is not None


WITHOUT_SENSORS = b',"sensors":{}}'
"""What messages omit of which `sensors` is the last field."""


class BadMessageError(ValueError):
    """A payload that is not a valid message; the text is one sentence with the reason."""


def valid(decode: Callable[..., Any], *payload: bytes) -> Any:
    """The message that `decode` returns of a payload, by default of its own; None if that is not valid."""
    try:
        return decode(*payload)
    except BadMessageError:
        return None


class Message(Part):
    """A whole message."""

    max_bytes: ClassVar[int] = 65_536
    """A longer payload is refused without being parsed."""

    version: str = VERSION
    """Version of the protocol that the sender implements, "major.minor"."""

    omitted: ClassVar[bytes] = b""
    """End of the JSON that is omitted: a last field that most messages have empty."""

    def encode(self) -> bytes:
        """The message as UTF-8 JSON; floats keep every bit."""
        payload = encode(self)
        if self.omitted and payload.endswith(self.omitted):
            return payload[: -len(self.omitted)] + b"}"
        return payload

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        """The message in a payload.

        Raises:
            BadMessageError: too long, not JSON, not this message, or of another major version.
        """
        if len(payload) > cls.max_bytes:
            raise BadMessageError(f"{cls.__name__}: {len(payload)} bytes, at most {cls.max_bytes}")
        try:
            message: Self = decoder(cls).decode(payload)
        except (ValueError, RecursionError):
            raise BadMessageError(f"{cls.__name__}: {_fault(cls, payload)}") from None
        if message.version != VERSION and message.version.split(".")[0] != _MAJOR:
            raise BadMessageError(f"{cls.__name__}: {_both_versions(message.version)}")
        return message


class _Versioned(msgspec.Struct):
    version: str = VERSION


_version = msgspec.json.Decoder(_Versioned)
_MAJOR = VERSION.split(".")[0]
_PLAIN_VERSION = re.compile(r"[0-9.]{1,20}")


def _fault(kind: type[Message], payload: bytes) -> str:
    """Why a payload was refused: another major version explains more than the first fault."""
    try:
        version = _version.decode(payload).version
    except (ValueError, RecursionError):
        version = VERSION
    is_other = version.split(".")[0] != _MAJOR
    return _both_versions(version) if is_other else fault_of_payload(kind, payload).sentence()


def _both_versions(theirs: str) -> str:
    shown = theirs if _PLAIN_VERSION.fullmatch(theirs) else repr(theirs[:20])
    return f"version {shown} is not supported, this side has {VERSION}; update the older side"
