"""A recording simulated again and compared, tick by tick: where `recordings` and `sim_host` meet.

The recording gives what was noted of each tick; the world part of the simulation goes the same way once more. Segments
that begin with a checkpoint need nothing of what was before, and are gone over by several processes at once.
"""

import math
import time
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, field
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple

from recordings.reading.command_check import CommandMismatch
from recordings.reading.recording import Recording, open_recording
from recordings.reading.tick_index import Segment, SkippedTicks, SkipReason, TickIndex, tick_index_of
from recordings.reading.tick_records import TickRecord, command_check_of, tick_records
from schemas.errors import TouchlineError
from schemas.messages.host import Applied, chained_part_of
from schemas.wire.message import BadMessageError
from sim_host.match.resimulation import ImpossibleTickError, Resimulation
from sim_host.match.world_difference import differences
from sim_host.physics.fingerprint import fingerprint
from touchline.verify.resim_start import resim_start

_WORTH_A_PROCESS = 1500
"""Ticks; to start a process takes as long as to simulate so many."""


@dataclass(frozen=True, slots=True)
class Detail:
    """One thing that is not as it was recorded."""

    of: str
    """`cyan2`, `ball`, `world`; `input of cyan2` where an input and the recorded command differ."""
    field: str
    recorded: Any
    simulated: Any
    """For an input: what the command says."""
    by: float | None = None
    """How much, where both are numbers: m, m/s, rad or rad/s."""


@dataclass(frozen=True, slots=True)
class Discrepancy:
    """The first tick that is not as it was recorded."""

    tick: int
    time: float
    """Simulated time in s."""
    why: str
    details: list[Detail] = field(default_factory=list)


@dataclass(slots=True)
class Verdict:
    """What came of verifying a recording."""

    ticks: int = 0
    """Simulated again and found to be as recorded."""
    seconds: float = 0.0
    """Their simulated time."""
    took: float = 0.0
    """Wall time in s."""
    kick_offs: int = 0
    """Of the whole recording."""
    processes: int = 1
    other_machine: dict[str, tuple[str, str]] = field(default_factory=dict)
    """Part of the fingerprint → recorded, here; where they differ."""
    difference: Discrepancy | None = None
    left_out: list[SkippedTicks] = field(default_factory=list)
    without_world: int = 0
    """Ticks whose `world` was not recorded: of them the chain alone was compared."""

    @property
    def identical(self) -> bool:
        """Nothing differs, nothing is missing in between, and something was compared."""
        return (
            self.ticks > 0
            and self.difference is None
            and all(one.why is not SkipReason.MISSING for one in self.left_out)
        )

    def to_json(self) -> dict[str, Any]:
        """The verdict as plain lists, numbers and texts."""
        fields = asdict(self)
        fields["left_out"] = [one._asdict() for one in self.left_out]
        return {"identical": self.identical, **fields}


class _SegmentResult(NamedTuple):
    """What came of one segment."""

    ticks: int
    without_world: int
    difference: Discrepancy | None


def verify(path: Path, from_kick_off: int | None = None, processes: int = 1) -> Verdict:
    """Simulate a recording again and compare every tick, from tick 0 or from the kick-off of this number.

    Raises:
        TouchlineError: no recording, not that many kick-offs, or nothing in it can be simulated again.
    """
    began = time.perf_counter()
    recording = open_recording(path)
    index = tick_index_of(recording)
    since = _since(path, index, from_kick_off)
    whole = sum(1 for start in index.starts if start.tick >= since)
    worth = _WORTH_A_PROCESS if processes > 1 and whole > 1 else math.inf
    segments = list(index.segments(since, worth))
    if not segments:
        raise TouchlineError(
            f"{path}: nothing in it can be simulated again; it takes what was applied at tick 0, or at a kick-off "
            "and the tick before (host/applied and world)"
        )
    verdict = Verdict(
        kick_offs=len(index.kick_offs),
        processes=min(processes, len(segments)),
        other_machine=_other_machine(recording),
        left_out=list(index.skipped(since)),
    )
    for segment, result in zip(segments, _all(path, segments, verdict.processes), strict=True):
        verdict.ticks += result.ticks
        verdict.without_world += result.without_world
        verdict.seconds += (segment.seconds[1] - segment.seconds[0]) * result.ticks / max(1, len(segment.ticks))
        verdict.difference = result.difference
        if verdict.difference is not None:
            break
    verdict.took = time.perf_counter() - began
    return verdict


def _since(path: Path, index: TickIndex, from_kick_off: int | None) -> int:
    if from_kick_off is None:
        return 0
    for start in index.kick_offs:
        if start.kick_off == from_kick_off:
            return start.tick
    there = len(index.kick_offs)
    says = f"{path} has {there} that it can begin with, counted from 1" if there else f"{path} has none to begin with"
    raise TouchlineError(f"--from-kickoff is {from_kick_off}; {says}")


def _other_machine(recording: Recording) -> dict[str, tuple[str, str]]:
    """What of the fingerprint differs between the machine that simulated the match and this one."""
    setup = recording.manifest.setup
    theirs, ours = setup.engine if setup is not None else {}, fingerprint()
    return {part: (told, ours[part]) for part, told in theirs.items() if part in ours and told != ours[part]}


def _all(path: Path, segments: list[Segment], processes: int) -> Iterable[_SegmentResult]:
    """What comes of each segment, one after the other or by several processes; it is asked for up to a difference."""
    if processes == 1:
        for segment in segments:
            yield resimulate_segment(path, segment)
        return
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        yield from pool.map(resimulate_segment, [path] * len(segments), segments)


def resimulate_segment(path: Path, segment: Segment) -> _SegmentResult:
    """Simulate one segment again, up to the first tick that is not as it was recorded.

    Raises:
        TouchlineError: the recording is damaged, or does not say how the match was set up.
    """
    recording = open_recording(path)
    check = command_check_of(recording, segment)
    first = segment.ticks.start
    ticks = without_world = 0
    difference: Discrepancy | None = None
    again: Resimulation | None = None
    before: TickRecord | None = None
    try:
        for record in tick_records(recording, segment, check):
            if record.tick < first:
                before = record
                continue
            try:
                again = again or Resimulation(*resim_start(recording, segment, before))
                applied: Applied = record.applied or record.recorded.message()  # which says what is wrong with it
                check.add_applied(applied)
                difference = _compared(again, applied, record)
            except (BadMessageError, ImpossibleTickError) as error:
                difference = Discrepancy(record.tick, record.recorded.time, f"cannot have been: {error}")
            if difference is not None:
                break
            ticks += 1
            without_world += record.world is None
    finally:
        if again is not None:
            again.close()
    return _with_contradictions(_SegmentResult(ticks, without_world, difference), check.mismatches(), segment)


def _compared(again: Resimulation, applied: Applied, record: TickRecord) -> Discrepancy | None:
    """One tick; nothing when it is as recorded."""
    tick = again.step(applied, chained_part_of(record.recorded.payload))
    found = differences(record.world, tick.bodies) if record.world is not None else []
    if not found and tick.chain == applied.chain:
        return None
    details = [Detail(one.body, one.field, one.recorded, one.simulated, one.by) for one in found]
    if tick.chain == applied.chain:
        why = "the hash chain is the same, the recorded world is another"
    elif found:
        why = "the world comes to another state"
    elif record.world is None:
        why = "the hash chain differs, and no world was recorded to compare"
    else:
        why = (
            "the hash chain differs and the world does not: what was noted of this tick was changed, "
            "or the ball's spin is another"
        )
    return Discrepancy(applied.tick, applied.time, why, details)


def _with_contradictions(result: _SegmentResult, mismatches: list[CommandMismatch], segment: Segment) -> _SegmentResult:
    """The same with inputs that are not the recorded commands, where they come first."""
    end = result.difference.tick if result.difference is not None else segment.ticks.stop
    # where the segment was left early, a command that is missing may have been yet to come
    known = [one for one in mismatches if one.tick <= end and (result.difference is None or one.field != "command")]
    if not known:
        return result
    tick = known[0].tick
    details = [_detail(one) for one in known if one.tick == tick]
    who = ", ".join(dict.fromkeys(one.robot for one in known if one.tick == tick))
    why = f"what {who} was told is not what its program said"
    if result.difference is not None and result.difference.tick == tick:
        why, details = f"{why}; {result.difference.why}", details + result.difference.details
    begins, ends = segment.seconds
    share = (tick - segment.ticks.start) / max(1, len(segment.ticks) - 1)
    moment = begins + share * (ends - begins)
    return result._replace(ticks=tick - segment.ticks.start, difference=Discrepancy(tick, moment, why, details))


def _detail(one: CommandMismatch) -> Detail:
    numbers = [value for value in (one.applied, one.sent) if isinstance(value, float)]
    by = abs(numbers[0] - numbers[1]) if len(numbers) == 2 else None
    return Detail(f"input of {one.robot}", one.field, one.applied, one.sent, by)
