"""What a recording says of itself: the manifest, its first metadata record, and the result, its last."""

from datetime import UTC, datetime
from enum import StrEnum
from typing import Any, Self

from pydantic import model_validator

from recordings.container.environment import libm_fingerprint, versions
from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.container.scene_by_name import with_scene
from schemas.config.match_config import MatchConfig
from schemas.game import Phase, Score
from schemas.message import VERSION, Name, Part
from schemas.messages.host import Setup
from schemas.process.clock import Clock
from schemas.topics import EVENT

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
    unreadable: dict[str, int] = {}
    """Payloads that the recorder itself wanted to read and could not, by key; recorded all the same."""
    keys: dict[str, KeyCount] = {}

    def counted(self, keys: dict[str, KeyCount]) -> "Result":
        """The same match, with the counts of a file that holds these."""
        totals = {name: sum(getattr(count, name) for count in keys.values()) for name in _SUMMED_COUNTS}
        events = keys.get(EVENT.key, KeyCount()).messages
        return self.model_copy(update={"keys": keys, "events": events, **totals})


_SUMMED_COUNTS = ("messages", "lost", "missed_before_start")


def make_manifest(
    match: str,
    recorder: str,
    clock: Clock,
    setup: Setup | None,
    config: MatchConfig | None,
    *,
    sights: bool,
    selection: KeySelection = EVERYTHING,
) -> Manifest:
    """The manifest of a recording that begins now, on this machine."""
    return Manifest(
        contract=VERSION,
        match=match,
        recorder=recorder,
        started=timestamp(clock),
        sights=sights,
        versions=versions(),
        libm=libm_fingerprint(),
        setup=setup,
        config=config,
        include=list(selection.include),
        exclude=list(selection.exclude),
    )


def timestamp(clock: Clock) -> str:
    """The clock's wall time, ISO 8601, UTC, to the millisecond."""
    return datetime.fromtimestamp(clock.unix_ns() / 1e9, UTC).isoformat(timespec="milliseconds")
