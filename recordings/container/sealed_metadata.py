"""A message part as MCAP metadata, sealed with a digest over all its fields.

MCAP metadata maps strings to strings: a field that is a string is stored as it is, any other field as JSON. Fields that
are None are left out.
"""

import hashlib
import types
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin

import msgspec
from pydantic_core import from_json

from schemas.errors import TouchlineError
from schemas.wire.faults import FaultError
from schemas.wire.part import Part, encode
from schemas.wire.part_faults import validated

_DIGEST = "digest"

P = TypeVar("P", bound=Part)


def to_metadata(part: Part) -> dict[str, str]:
    """The fields of a part as MCAP metadata, sealed."""
    fields = part.plain()
    return sealed(
        {
            name: value if isinstance(value, str) else encode(value).decode()
            for name, value in fields.items()
            if value is not None
        }
    )


def sealed(metadata: dict[str, str]) -> dict[str, str]:
    """The metadata with a digest over all its fields. MCAP has checksums for chunks, but none for metadata."""
    fields = {name: value for name, value in metadata.items() if name != _DIGEST}
    return {**fields, _DIGEST: digest(encode(sorted(fields.items())))}


def digest(content: bytes) -> str:
    """blake2b of bytes, hex."""
    return hashlib.blake2b(content, digest_size=16).hexdigest()


def is_sealed(metadata: dict[str, str]) -> bool:
    """Whether metadata is complete and unchanged since it was written."""
    return metadata.get(_DIGEST) == sealed(metadata)[_DIGEST]


def from_metadata(model: type[P], metadata: dict[str, str]) -> P:
    """Read a part from MCAP metadata. Fields that a later version added are ignored.

    Raises:
        TouchlineError: the metadata is not a valid part of this kind.
    """
    written = {field.name: field.type for field in msgspec.structs.fields(model)}
    known = {name: kind for name, kind in written.items() if name in metadata}
    try:
        fields = {name: metadata[name] if _is_text(kind) else from_json(metadata[name]) for name, kind in known.items()}
        return validated(model, fields)
    except FaultError as error:
        raise TouchlineError(str(error)) from None
    except ValueError as error:
        raise TouchlineError(f"not JSON: {error}") from None


def _is_text(kind: Any) -> bool:
    if get_origin(kind) in (Annotated, Union, types.UnionType):
        return any(_is_text(choice) for choice in get_args(kind))
    return isinstance(kind, type) and issubclass(kind, str)
