"""Manifest and result of a recording: its first and its last metadata record."""

from datetime import UTC, datetime
from enum import StrEnum

from recordings.container.environment import libm_fingerprint, versions
from recordings.container.key_selection import EVERYTHING, KeySelection
from runtime.process.clock import Clock
from schemas.config.match_config import MatchConfig
from schemas.messages.setup import Setup
from schemas.soccer.game import Phase, Score
from schemas.topics import EVENT
from schemas.wire.message import VERSION, Name
from schemas.wire.part import Part

MANIFEST = "manifest"
RESULT = "result"
"""Names of the two metadata records."""
MANIFEST_COPY = "manifest_copy"
"""Name of the manifest's second record: without a manifest nothing of a file can be read."""
RECOVERED = "recovered"
"""Name of the metadata record that a repair adds."""
DAMAGED_RECORDS = "damaged_records"
"""Field of that record: the number of damaged records that were left out."""


class Manifest(Part):
    """How the match was set up, and with which versions and options it was recorded."""

    contract: str
    """Version of the messages."""
    match: Name
    recorder: Name
    started: str
    """Wall time at which the recording began, ISO 8601, UTC."""
    sights: bool
    """Whether the sights of the robots are recorded, too."""
    versions: dict[str, str]
    libm: str
    """Fingerprint of the mathematical functions of the recording machine."""
    setup: Setup | None = None
    """The setup that the host reported; None if it reported none."""
    config: MatchConfig | None = None
    """The match file; None if the recorder was not given one."""
    include: list[str] = []
    """Key expressions of the recorded keys; empty if all keys were recorded."""
    exclude: list[str] = []
    """Key expressions of the keys that were left out."""
    host: int = 0
    """The host's `stream`, as in its record batches; 0 if it is not known."""
    part: int = 1
    """Number of this part of the recording, from 1."""
    begins_ns: int = 0
    """Simulated time in ns before which messages of this file are only repeated: they show the state at that time."""
    attached: dict[str, str] = {}
    """Attachment → blake2b of its content, hex."""
    made: str = "recorded"
    """`recorded`, or `filtered` for a copy of a part of a recording."""
    damaged_records: int = 0
    """Damaged records that a repair has left out of what was copied."""


class EndReason(StrEnum):
    """Why a recording ended."""

    FULL_TIME = "full_time"
    """The match was played to its end."""
    HOST_GONE = "host_gone"
    """The host left, crashed, or stayed unreachable before full time."""
    STOPPED = "stopped"
    """The recorder was stopped before full time."""
    CONTINUED = "continued"
    """The recording continues in the next part."""


class KeyCount(Part):
    """Counts of the messages on one key."""

    messages: int = 0
    bytes: int = 0
    """Sum of the payloads."""
    lost: int = 0
    """Messages missing between the first and the last received one."""
    missed_before_start: int = 0
    """Messages that a sender had sent before its first received one."""
    duplicates: int = 0
    late: int = 0
    """Messages received after a message that was sent later."""
    restarts: int = 0
    """How often a sender restarted its sequence numbers, or another sender began to count its own."""
    unstamped: int = 0
    """Messages without a sequence number, from a sender that does not use this library: their losses are unknown."""


class Result(Part):
    """How the match and its recording ended."""

    ended: EndReason
    finished: str
    """Wall time at which the recording ended, ISO 8601, UTC."""
    phase: Phase | None = None
    score: Score | None = None
    value: float | None = None
    """Score of a game without goals."""
    clock: float = 0.0
    """Game clock in s."""
    tick: int = -1
    """The last tick whose inputs were recorded; -1 if there is none."""
    time: float = 0.0
    """Simulated time of that tick in s."""
    events: int = 0
    messages: int = 0
    lost: int = 0
    missed_before_start: int = 0
    lost_batches: int = 0
    """Batches of the host that this recorder could not fetch any more, so far; `lost` counts the messages that were in
    them, on each key that has a later one."""
    unreadable: dict[str, int] = {}
    """Key → payloads that the recorder itself could not decode; they are recorded nevertheless."""
    keys: dict[str, KeyCount] = {}

    def counted(self, keys: dict[str, KeyCount]) -> "Result":
        """The same result with these counts, and with their totals."""
        totals = {name: sum(getattr(count, name) for count in keys.values()) for name in _SUMMED_COUNTS}
        events = keys.get(EVENT.key, KeyCount()).messages
        return self.replace(keys=keys, events=events, **totals)


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
    host: int = 0,
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
        host=host,
    )


def timestamp(clock: Clock) -> str:
    """The clock's wall time, ISO 8601, UTC, to the millisecond."""
    return datetime.fromtimestamp(clock.unix_ns() / 1e9, UTC).isoformat(timespec="milliseconds")
