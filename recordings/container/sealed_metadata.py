"""A message part as MCAP metadata, sealed with a digest over all its fields.

MCAP metadata maps strings to strings: a field that is a string is stored as it is, any other field as JSON. Fields that
are None are left out.
"""

import hashlib
import types
from typing import Any, TypeVar, get_args

from pydantic import ValidationError
from pydantic_core import from_json, to_json, to_jsonable_python

from schemas.errors import TouchlineError
from schemas.wire.faults import fault_of
from schemas.wire.message import Part

_DIGEST = "digest"

P = TypeVar("P", bound=Part)


def to_metadata(part: Part) -> dict[str, str]:
    """The fields of a part as MCAP metadata, sealed."""
    fields = to_jsonable_python(part)
    return sealed(
        {
            name: value if isinstance(value, str) else to_json(value).decode()
            for name, value in fields.items()
            if value is not None
        }
    )


def sealed(metadata: dict[str, str]) -> dict[str, str]:
    """The metadata with a digest over all its fields. MCAP has checksums for chunks, but none for metadata."""
    fields = {name: value for name, value in metadata.items() if name != _DIGEST}
    return {**fields, _DIGEST: digest(to_json(sorted(fields.items())))}


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
    written = {field.alias or name: field.annotation for name, field in model.model_fields.items()}
    known = {name: kind for name, kind in written.items() if name in metadata}
    try:
        fields = {name: metadata[name] if _is_text(kind) else from_json(metadata[name]) for name, kind in known.items()}
        return model.model_validate_json(to_json(fields))
    except ValidationError as error:
        raise TouchlineError(fault_of(error, model).sentence()) from None
    except ValueError as error:
        raise TouchlineError(f"not JSON: {error}") from None


def _is_text(kind: Any) -> bool:
    if isinstance(kind, types.UnionType):
        return any(_is_text(choice) for choice in get_args(kind))
    return isinstance(kind, type) and issubclass(kind, str)
