"""What a recording says of itself: the manifest, its first metadata record, and the result, its last.

MCAP metadata maps text to text: a field that is text stands as it is, any other as JSON, one that is nothing is left
out.
"""

import types
from enum import StrEnum
from typing import Any, TypeVar, get_args

from pydantic import ValidationError
from pydantic_core import from_json, to_json, to_jsonable_python

from schemas.errors import TouchlineError
from schemas.game import Phase, Score
from schemas.host import Setup
from schemas.match_config import MatchConfig
from schemas.message import Name, Part

MANIFEST = "manifest"
RESULT = "result"
"""Names of the two metadata records."""


class Manifest(Part):
    """How the match was set up, and what the recording was made with."""

    contract: str
    """Version of the messages."""
    match: Name
    recorder: Name
    started: str
    """Wall time at which the recording began, ISO 8601, UTC."""
    sights: bool
    """Whether what the robots perceived is recorded too."""
    versions: dict[str, str]
    libm: str
    """Fingerprint of the mathematical functions of the recording machine."""
    setup: Setup | None = None
    """The host's own words; nothing when it gave none."""
    config: MatchConfig | None = None
    """The match file; nothing when the recorder was not told."""


class Ended(StrEnum):
    """How a recording came to its end."""

    FULL_TIME = "full_time"
    """The match was played to its end."""
    HOST_GONE = "host_gone"
    """The host left, died, or was cut off for good, before full time."""
    STOPPED = "stopped"
    """The recorder was told to stop before full time."""


class KeyCount(Part):
    """What came on one key."""

    messages: int = 0
    bytes: int = 0
    """Sum of the payloads."""
    lost: int = 0
    """Messages missing between the first and the last that came."""
    missed_before_start: int = 0
    """Messages that a writer had sent before the first of it that came."""
    duplicates: int = 0
    late: int = 0
    """Messages that came after one the writer sent later."""
    restarts: int = 0
    """How often the writer began to count anew."""
    unstamped: int = 0
    """Messages without a sequence number, from a writer that does not use this library: their losses are unknown."""


class Result(Part):
    """How the match and its recording ended."""

    ended: Ended
    finished: str
    """Wall time at which the recording ended, ISO 8601, UTC."""
    phase: Phase | None = None
    score: Score | None = None
    clock: float = 0.0
    """Game clock in s."""
    tick: int = -1
    """The last tick whose inputs were recorded, -1 when none was."""
    time: float = 0.0
    """Simulated time of that tick in s."""
    events: int = 0
    messages: int = 0
    lost: int = 0
    missed_before_start: int = 0
    unreadable: dict[str, int] = {}
    """Payloads that the recorder itself wanted to read and could not, by key; recorded all the same."""
    keys: dict[str, KeyCount] = {}


def to_metadata(part: Part) -> dict[str, str]:
    """The fields of a part as MCAP metadata."""
    fields = to_jsonable_python(part)
    return {
        name: value if isinstance(value, str) else to_json(value).decode()
        for name, value in fields.items()
        if value is not None
    }


P = TypeVar("P", Manifest, Result)


def from_metadata(model: type[P], metadata: dict[str, str]) -> P:
    """The part that stands in MCAP metadata; fields that a later version added are passed over.

    Raises:
        TouchlineError: it does not hold such a part.
    """
    known = {name: field.annotation for name, field in model.model_fields.items() if name in metadata}
    try:
        fields = {name: metadata[name] if _is_text(kind) else from_json(metadata[name]) for name, kind in known.items()}
        return model.model_validate_json(to_json(fields))
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        raise TouchlineError(f"{'.'.join(map(str, first['loc']))}: {first['msg']}") from None
    except ValueError as error:
        raise TouchlineError(f"not JSON: {error}") from None


def _is_text(kind: Any) -> bool:
    if isinstance(kind, types.UnionType):
        return any(_is_text(choice) for choice in get_args(kind))
    return isinstance(kind, type) and issubclass(kind, str)
