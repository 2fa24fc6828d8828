"""What a recording says of itself: the manifest, its first metadata record, and the result, its last.

MCAP metadata maps text to text: a field that is text stands as it is, any other as JSON, one that is nothing is left
out.
"""

import hashlib
import types
from enum import StrEnum
from typing import Any, Self, TypeVar, get_args

from pydantic import ValidationError, model_validator
from pydantic_core import from_json, to_json, to_jsonable_python

from recordings.container.scene_by_name import with_scene
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.faults import fault_of
from schemas.game import Phase, Score
from schemas.message import Name, Part
from schemas.messages.host import Setup
from schemas.topics import EVENT

MANIFEST = "manifest"
RESULT = "result"
"""Names of the two metadata records."""
_DIGEST = "digest"


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
    missing_scene: str | None = None
    """The scene that `config` named and that could not be read: `config.robots` does not give who played then."""
    include: list[str] = []
    """Key expressions that were recorded; all where there is none."""
    exclude: list[str] = []
    """Key expressions that were not."""
    part: int = 1
    """Which file of a recording that was split, from 1."""
    standing: int = 0
    """So many messages at the beginning of the file repeat what stood when it began; files before it have them too."""
    attached: dict[str, str] = {}
    """Attachment → blake2b of its content, hex."""
    made: str = "recorded"
    """`recorded`, or how it was made of other recordings: `filtered`, `merged`."""

    @model_validator(mode="before")
    @classmethod
    def _embed_scene(cls, fields: Any) -> Any:
        return with_scene(fields) if isinstance(fields, dict) else fields


class EndReason(StrEnum):
    """How a recording came to its end."""

    FULL_TIME = "full_time"
    """The match was played to its end."""
    HOST_GONE = "host_gone"
    """The host left, died, or was cut off for good, before full time."""
    STOPPED = "stopped"
    """The recorder was told to stop before full time."""
    SPLIT = "split"
    """It goes on in the next file."""
    SNAPSHOT = "snapshot"
    """The file holds a moment of the match that somebody wanted to keep."""


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
    left_out: int = 0
    """Messages that came while the recorder was paused."""

    def since(self, before: "KeyCount") -> Self:
        """What was counted after `before`; none is below 0, though a late message takes back a loss."""
        return type(self)(
            **{name: max(0, getattr(self, name) - getattr(before, name)) for name in KeyCount.model_fields}
        )


class Result(Part):
    """How the match and its recording ended."""

    ended: EndReason
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
    lost_batches: int = 0
    """Batches of the host that could not be fetched any more, so far; `lost` counts the messages that were in
    them, on each key that has a later one."""
    unreadable: dict[str, int] = {}
    """Payloads that the recorder itself wanted to read and could not, by key; recorded all the same."""
    keys: dict[str, KeyCount] = {}

    def counted(self, keys: dict[str, KeyCount]) -> "Result":
        """The same match, with the counts of a file that holds these."""
        totals = {name: sum(getattr(count, name) for count in keys.values()) for name in _SUMMED_COUNTS}
        events = keys.get(EVENT.key, KeyCount()).messages
        return self.model_copy(update={"keys": keys, "events": events, **totals})


_SUMMED_COUNTS = ("messages", "lost", "missed_before_start")


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
    """The metadata with a digest over all its fields: MCAP guards its chunks with checksums, but not its metadata."""
    fields = {name: value for name, value in metadata.items() if name != _DIGEST}
    return {**fields, _DIGEST: digest(to_json(sorted(fields.items())))}


def digest(content: bytes) -> str:
    """blake2b of bytes, hex."""
    return hashlib.blake2b(content, digest_size=16).hexdigest()


def is_sealed(metadata: dict[str, str]) -> bool:
    """Whether metadata is as it was written, and all of it is there."""
    return metadata.get(_DIGEST) == sealed(metadata)[_DIGEST]


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
        raise TouchlineError(fault_of(error, model).sentence()) from None
    except ValueError as error:
        raise TouchlineError(f"not JSON: {error}") from None


def _is_text(kind: Any) -> bool:
    if isinstance(kind, types.UnionType):
        return any(_is_text(choice) for choice in get_args(kind))
    return isinstance(kind, type) and issubclass(kind, str)
