"""The base of every wire message: frozen, closed, finite, and versioned."""

from typing import Annotated, Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, StringConstraints, ValidationError

VERSION = "1.0"
"""Version of the contract that this code speaks, "major.minor"."""

Name = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_]*$", max_length=32)]
"""A key chunk: the name of a robot, a match, a process."""


Source = Annotated[str, StringConstraints(pattern=r"^[^\x00-\x1f\x7f-\x9f]*$", max_length=80)]
"""Who asks, in words that are shown to people: one line without control characters, which a terminal would obey."""


class BadMessageError(ValueError):
    """A payload that is not a valid message; the sentence says why."""


class Part(BaseModel):
    """A part of a message: no extra fields, no NaN or infinity, never changed after it was made."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True, from_attributes=True
    )


class Message(Part):
    """A whole message; carries the version of the contract."""

    max_bytes: ClassVar[int] = 65_536
    """A payload longer than this is refused unread."""

    version: str = VERSION

    def encode(self) -> bytes:
        """The message as UTF-8 JSON; floats keep every bit."""
        return self.__pydantic_serializer__.to_json(self, by_alias=True)

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        """The message in a payload.

        Raises:
            BadMessageError: too long, not JSON, not this message, or of another major version.
        """
        if len(payload) > cls.max_bytes:
            raise BadMessageError(f"{cls.__name__}: {len(payload)} bytes, at most {cls.max_bytes}")
        try:
            message = cls.__pydantic_validator__.validate_json(payload)
        except ValidationError as error:
            raise BadMessageError(_why(cls.__name__, payload, error)) from None
        if message.version != VERSION and message.version.split(".")[0] != _MAJOR:
            raise BadMessageError(_versions(cls.__name__, message.version))
        return message  # type: ignore[no-any-return]


def reason_of(error: ValidationError) -> str:
    """What is wrong with the content of a message, in one phrase: a field that is wrong, or two that do not agree."""
    first = error.errors(include_url=False)[0]
    reason = first["msg"].removeprefix("Value error, ")
    where = ".".join(str(step) for step in first["loc"])
    return f"{where} is {first['input']!r:.60}: {reason[0].lower()}{reason[1:]}" if where else reason


_MAJOR = VERSION.split(".")[0]


def _versions(name: str, theirs: str) -> str:
    return f"{name}: version {theirs} is not spoken here, this side speaks {VERSION}; update the older side"


def _why(name: str, payload: bytes, error: ValidationError) -> str:
    """One line for a payload that did not validate: another major version explains more than its first odd field."""
    theirs = _version_of(payload)
    if theirs is not None and theirs.split(".")[0] != _MAJOR:
        return _versions(name, theirs)
    first = error.errors(include_url=False)[0]
    where = ".".join(str(step) for step in first["loc"]) or "payload"
    value = repr(first["input"])
    return f"{name}: {where} is {value[:60]}: {first['msg']}"


def _version_of(payload: bytes) -> str | None:
    from pydantic_core import from_json

    try:
        content: Any = from_json(payload)
    except ValueError:
        return None
    version = content.get("version") if isinstance(content, dict) else None
    return version if isinstance(version, str) else None
