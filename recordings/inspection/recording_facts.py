"""Facts of a recording: the match, how it ended, the recorded messages and the losses."""

from collections.abc import Iterator
from dataclasses import dataclass

from recordings.container.manifest import EndReason, KeyCount, Result
from recordings.inspection.contradictions import contradictions
from recordings.reading.recording import Recording
from recordings.recorder.match_progress import FOLLOWED, MatchProgress
from recordings.recorder.sequence_tracker import LossCounts
from schemas.config.number_files import UNVERSIONED

CUT_OFF = "cut_off"
"""Stands for the end reason of a recording that its recorder did not finish."""


@dataclass(frozen=True, slots=True)
class KeyFacts:
    """Facts of one key."""

    key: str
    message: str
    messages: int
    rate: float
    """Messages per simulated second."""
    bytes: int
    """Sum of the payloads."""
    lost: int
    missed_before_start: int


@dataclass(frozen=True, slots=True)
class RecordingFacts:
    """Facts of a recording."""

    path: str
    complete: bool
    """Whether its recorder finished the file."""
    match: str
    pace: str | None
    profile: str | None
    profile_version: int
    """0 for a file without a version."""
    rules: str | None
    rules_version: int
    """0 for a file without a version."""
    seed: int | None
    teams: dict[str, str]
    """Side → name of its team."""
    started: str
    """Wall time, ISO 8601, UTC."""
    duration: float
    """Simulated time from the first to the last message, in s."""
    start: float
    """Simulated time of the first message, in s, without messages that are repeated at the beginning."""
    end: float
    """Simulated time of the last message, in s."""
    tick: int
    """The last tick whose inputs were recorded, before the recording was filtered; −1 if there is none."""
    time: float
    """Simulated time of that tick, in s."""
    phase: str | None
    score: dict[str, int] | None
    """Side → its goals; None for a game without goals."""
    value: float | None
    """Score of a task."""
    unit: str
    """Unit of that score; empty without one."""
    ended: str
    events: int
    messages: int
    lost: int
    missed_before_start: int
    part: int
    """Number of this part of the recording, from 1."""
    made: str
    """`recorded`, or how it was made from other recordings."""
    include: list[str]
    """Key expressions of the recorded keys; empty if all keys were recorded."""
    exclude: list[str]
    """Key expressions of the keys that were left out."""
    damaged: list[str]
    """Attachments that are missing or have changed."""
    drawn: dict[str, int]
    """Topic → messages for viewers, which are not in the other counts."""
    size: int
    """Bytes of the file."""
    keys: list[KeyFacts]
    contradictions: list[str]
    """Sentences on where result, manifest and attachments do not fit the messages and each other."""


def facts_of(recording: Recording) -> RecordingFacts:
    """The facts of a recording; of a truncated file they are collected from its messages."""
    manifest, setup, config = recording.manifest, recording.manifest.setup, recording.manifest.config
    ended, ending = _ending(recording)
    start, end = _extent(recording)
    described = setup or config
    teams = {
        side.value: team.name
        for side, team in (setup.teams if setup is not None else {}).items()
        if team.robots or setup is None or setup.free is None
    }
    task, has_goals = (described.task, described.free is None) if described is not None else (None, True)
    return RecordingFacts(
        path=str(recording.path),
        complete=recording.complete,
        match=manifest.match,
        pace=described.pace if described is not None else None,
        profile=described.profile if described is not None else None,
        profile_version=setup.profile_version if setup is not None else UNVERSIONED,
        rules=described.rules if described is not None and has_goals else None,
        rules_version=setup.rules_version if setup is not None else UNVERSIONED,
        seed=config.seed if config is not None else None,
        teams=teams,
        started=manifest.started,
        duration=end - start,
        start=start,
        end=end,
        tick=ending.tick,
        time=ending.time,
        phase=ending.phase.value if ending.phase is not None else None,
        score=ending.score.plain() if ending.score is not None and has_goals else None,
        value=ending.value,
        unit=task.unit if task is not None else "",
        ended=ended,
        events=ending.events,
        messages=ending.messages,
        lost=ending.lost,
        missed_before_start=ending.missed_before_start,
        part=manifest.part,
        made=manifest.made,
        include=manifest.include,
        exclude=manifest.exclude,
        damaged=recording.damaged,
        drawn=recording.drawn,
        size=recording.mcap_file.size,
        keys=list(_key_facts(recording, ending.keys)),
        contradictions=contradictions(recording),
    )


def _extent(recording: Recording) -> tuple[float, float]:
    """Simulated times of the first and the last message, in s."""
    channels = [channel for channel in recording.channels if channel.messages]
    start = min((channel.start for channel in channels), default=0.0)
    begins = recording.manifest.begins_ns / 1e9
    if begins:
        start = next((recorded.time for recorded in recording.messages(start=begins)), start)
    return start, max(start, max((channel.end for channel in channels), default=0.0))


def _ending(recording: Recording) -> tuple[str, Result]:
    """How the recording ended, and its result with the counts of this part."""
    result = recording.result
    if result is not None and result.keys and recording.manifest.part == 1:  # others have the counts of all parts
        return result.ended.value, result.counted(result.keys)
    progress = MatchProgress()
    counts = LossCounts()
    for recorded in recording.messages():
        if recorded.key in FOLLOWED:
            progress.update(recorded.received())
        if recorded.log_ns >= recording.manifest.begins_ns:
            counts.add([recorded])
    progress.catch_up()
    if result is not None:  # of a repaired file, or a later part
        return result.ended.value, result.counted(counts.counts())
    ended = EndReason.FULL_TIME if progress.finished else EndReason.STOPPED
    return ended.value if progress.finished else CUT_OFF, progress.result(ended, "", counts.counts())


def _key_facts(recording: Recording, counts: dict[str, KeyCount]) -> Iterator[KeyFacts]:
    for channel in recording.channels:
        count, lasts = counts.get(channel.key, KeyCount()), channel.end - channel.start
        yield KeyFacts(
            key=channel.key,
            message=channel.metadata.get("message", ""),
            messages=channel.messages,
            rate=(channel.messages - 1) / lasts if lasts > 0 else 0.0,
            bytes=count.bytes,
            lost=count.lost,
            missed_before_start=count.missed_before_start,
        )
