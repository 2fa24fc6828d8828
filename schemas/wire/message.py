"""The base of every wire message: frozen, without unknown fields, finite, and versioned.

Each message is a pydantic model or, where it is written and read in every tick, a msgspec struct
(`schemas.wire.struct`).
`WireMessage` is the interface of both.
"""

import re
from collections.abc import Callable
from typing import Annotated, Any, ClassVar, Protocol, Self, TypeVar

from msgspec import Meta
from pydantic import BaseModel, ConfigDict, StringConstraints, ValidationError
from pydantic_core import from_json, to_json

from schemas.wire.faults import Fault, fault_of
from schemas.wire.field_docstrings import Described
from schemas.wire.json_schema import with_definitions

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
Source = Annotated[str, StringConstraints(pattern=r"^[^\x00-\x1f\x7f-\x9f]*$", max_length=80)]
"""Name of the sender of a request, for display: one line without control characters, which a terminal would obey."""
ShortText = Annotated[str, Meta(max_length=80)]
M = TypeVar("M", bound="WireMessage")


def is_name(text: str) -> bool:
    """Whether a text is a `Name`."""
    return _NAME.fullmatch(text) is not None


class BadMessageError(ValueError):
    """A payload that is not a valid message; the text is one sentence with the reason."""


class WireMessage(Protocol):
    """The interface of every message, model or struct."""

    max_bytes: ClassVar[int]
    """A longer payload is refused without being parsed."""

    @property
    def version(self) -> str:
        """Version of the protocol that the sender implements."""

    def encode(self) -> bytes:
        """The message as UTF-8 JSON; floats keep every bit."""

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        """The message in a payload.

        Raises:
            BadMessageError: too long, not JSON, not this message, or of another major version.
        """

    def plain(self) -> dict[str, Any]:
        """The fields as JSON values: objects, lists, texts and numbers."""

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """The JSON Schema of the message as it is written, with all definitions."""


class Part(Described, BaseModel):
    """A part of a message: immutable, without unknown fields, NaN or infinity."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True)

    def plain(self) -> dict[str, Any]:
        """The fields as JSON values: objects, lists, texts and numbers."""
        return self.model_dump(mode="json", by_alias=True)

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """The JSON Schema of the part as it is written, with all definitions."""
        return with_definitions(cls.model_json_schema(by_alias=True, mode="serialization"))


class Message(Part):
    """A whole message, with the version of the protocol. See `WireMessage`."""

    max_bytes: ClassVar[int] = 65_536

    version: str = VERSION
    """Version of the protocol that the sender implements, "major.minor"."""

    def encode(self) -> bytes:
        """The message as UTF-8 JSON; floats keep every bit."""
        return to_json(self, by_alias=True)

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        """The message in a payload.

        Raises:
            BadMessageError: too long, not JSON, not this message, or of another major version.
        """
        return decode_payload(cls, payload, cls.model_validate_json, _fault)


def decode_payload(
    kind: type[M],
    payload: bytes,
    parse: Callable[[bytes], M],
    explain: Callable[[type[M], bytes, Exception], Fault],
) -> M:
    """The message that `parse` makes of a payload; `explain` names the fault of a payload that `parse` refuses.

    Raises:
        BadMessageError: too long, not JSON, not this message, or of another major version.
    """
    if len(payload) > kind.max_bytes:
        raise BadMessageError(f"{kind.__name__}: {len(payload)} bytes, at most {kind.max_bytes}")
    try:
        message = parse(payload)
    except (ValueError, RecursionError) as error:
        reason = _version_mismatch(payload) or explain(kind, payload, error).sentence()
        raise BadMessageError(f"{kind.__name__}: {reason}") from None
    if message.version != VERSION and message.version.split(".")[0] != _MAJOR:
        raise BadMessageError(f"{kind.__name__}: {_both_versions(message.version)}")
    return message


_MAJOR = VERSION.split(".")[0]
_PLAIN_VERSION = re.compile(r"[0-9.]{1,20}")


def _fault(kind: type[Message], _payload: bytes, error: Exception) -> Fault:
    assert isinstance(error, ValidationError)
    return fault_of(error, kind)


def _both_versions(theirs: str) -> str:
    shown = theirs if _PLAIN_VERSION.fullmatch(theirs) else repr(theirs[:20])
    return f"version {shown} is not supported, this side has {VERSION}; update the older side"


def _version_mismatch(payload: bytes) -> str:
    """The sentence for a payload of another major version, which explains more than its first fault; else empty."""
    try:
        content: Any = from_json(payload)
    except ValueError:
        return ""
    version = content.get("version") if isinstance(content, dict) else None
    return _both_versions(version) if isinstance(version, str) and version.split(".")[0] != _MAJOR else ""
