"""Simulates a recording again and compares it tick by tick, by means of `recordings` and `sim_host`.

The recording has the applied inputs of each tick; the world part of the simulation repeats them. A segment that begins
with a checkpoint does not depend on earlier ticks, so several processes verify segments in parallel.
"""

import math
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
from schemas.messages.applied import Applied, chained_part_of
from schemas.process.clock import WallClock
from schemas.wire.message import BadMessageError
from sim_host.match.resimulation import ImpossibleTickError, Resimulation
from sim_host.match.world_difference import differences
from sim_host.physics.fingerprint import fingerprint
from touchline.verify.resim_start import resim_start

_WORTH_A_PROCESS = 1500
"""Cost of starting a process, in simulated ticks."""


@dataclass(frozen=True, slots=True)
class Detail:
    """One value that differs from the recording."""

    of: str
    """`cyan2`, `ball`, `world`; `input of cyan2` where an input and the recorded command differ."""
    field: str
    recorded: Any
    simulated: Any
    """For an input: the value in the command."""
    by: float | None = None
    """Absolute difference if both values are numbers: m, m/s, rad or rad/s."""


@dataclass(frozen=True, slots=True)
class Discrepancy:
    """The first tick that differs from the recording."""

    tick: int
    time: float
    """Simulated time, s."""
    why: str
    details: list[Detail] = field(default_factory=list)


@dataclass(slots=True)
class Verdict:
    """The result of verifying a recording."""

    ticks: int = 0
    """Number of ticks that were simulated again and are identical."""
    seconds: float = 0.0
    """Simulated time of these ticks, s."""
    took: float = 0.0
    """Wall time of the verification, s."""
    kick_offs: int = 0
    """Number in the whole recording."""
    processes: int = 1
    other_machine: dict[str, tuple[str, str]] = field(default_factory=dict)
    """Part of the fingerprint → recorded value, value here; only parts that differ."""
    difference: Discrepancy | None = None
    left_out: list[SkippedTicks] = field(default_factory=list)
    without_world: int = 0
    """Ticks without a recorded `world`: only their hash chain was compared."""

    @property
    def identical(self) -> bool:
        """True if at least one tick was compared, no tick differs, and no tick in between is missing."""
        return (
            self.ticks > 0
            and self.difference is None
            and all(one.why is not SkipReason.MISSING for one in self.left_out)
        )

    def to_json(self) -> dict[str, Any]:
        """The verdict as plain JSON values."""
        fields = asdict(self)
        fields["left_out"] = [one._asdict() for one in self.left_out]
        return {"identical": self.identical, **fields}


class _SegmentResult(NamedTuple):
    """The result of one segment."""

    ticks: int
    without_world: int
    difference: Discrepancy | None


def verify(path: Path, from_kick_off: int | None = None, processes: int = 1) -> Verdict:
    """Simulate a recording again and compare every tick, from tick 0 or from the kick-off of this number.

    Raises:
        TouchlineError: not a recording, too few kick-offs, or no tick can be simulated again.
    """
    clock = WallClock()
    began = clock.now()
    recording = open_recording(path)
    index = tick_index_of(recording)
    since = _since(path, index, from_kick_off)
    whole = sum(1 for start in index.starts if start.tick >= since)
    worth = _WORTH_A_PROCESS if processes > 1 and whole > 1 else math.inf
    segments = list(index.segments(since, worth))
    if not segments:
        raise TouchlineError(
            f"{path}: no tick can be simulated again; that requires host/applied at tick 0, or at a kick-off, "
            "and host/applied and world of the tick before"
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
    verdict.took = clock.now() - began
    return verdict


def _since(path: Path, index: TickIndex, from_kick_off: int | None) -> int:
    if from_kick_off is None:
        return 0
    for start in index.kick_offs:
        if start.kick_off == from_kick_off:
            return start.tick
    there = len(index.kick_offs)
    choice = f"{path} has {there} to start from, counted from 1" if there else f"{path} has none to start from"
    raise TouchlineError(f"--from-kickoff is {from_kick_off}; {choice}")


def _other_machine(recording: Recording) -> dict[str, tuple[str, str]]:
    """The parts of the fingerprint that differ between the recording's machine and this one."""
    setup = recording.manifest.setup
    theirs, ours = setup.engine if setup is not None else {}, fingerprint()
    return {part: (value, ours[part]) for part, value in theirs.items() if part in ours and value != ours[part]}


def _all(path: Path, segments: list[Segment], processes: int) -> Iterable[_SegmentResult]:
    """Yield the result of each segment, in sequence or by several processes; the caller stops at a difference."""
    if processes == 1:
        for segment in segments:
            yield resimulate_segment(path, segment)
        return
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        yield from pool.map(resimulate_segment, [path] * len(segments), segments)


def resimulate_segment(path: Path, segment: Segment) -> _SegmentResult:
    """Simulate one segment again, up to the first tick that differs from the recording.

    Raises:
        TouchlineError: the recording is damaged, or lacks the setup of the match.
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
                applied: Applied = record.applied or record.recorded.message()  # raises the reason if it is damaged
                check.add_applied(applied)
                difference = _compared(again, applied, record)
            except (BadMessageError, ImpossibleTickError) as error:
                difference = Discrepancy(record.tick, record.recorded.time, f"this tick is impossible: {error}")
            if difference is not None:
                break
            ticks += 1
            without_world += record.world is None
    finally:
        if again is not None:
            again.close()
    return _with_contradictions(_SegmentResult(ticks, without_world, difference), check.mismatches(), segment)


def _compared(again: Resimulation, applied: Applied, record: TickRecord) -> Discrepancy | None:
    """Compare one tick; None if it is identical."""
    tick = again.step(applied, chained_part_of(record.recorded.payload))
    found = differences(record.world, tick.bodies) if record.world is not None else []
    if not found and tick.chain == applied.chain:
        return None
    details = [Detail(one.body, one.field, one.recorded, one.simulated, one.by) for one in found]
    if tick.chain == applied.chain:
        why = "the hash chain is the same, but the recorded world differs"
    elif found:
        why = "the simulated world differs"
    elif record.world is None:
        why = "the hash chain differs, and no world was recorded to compare"
    else:
        why = (
            "the hash chain differs and the world does not: the recorded inputs of this tick were changed, "
            "or the ball's spin differs"
        )
    return Discrepancy(applied.tick, applied.time, why, details)


def _with_contradictions(result: _SegmentResult, mismatches: list[CommandMismatch], segment: Segment) -> _SegmentResult:
    """The first difference, including inputs that differ from the recorded commands."""
    end = result.difference.tick if result.difference is not None else segment.ticks.stop
    # if the segment ended early, the recorded command of an input may come later
    known = [one for one in mismatches if one.tick <= end and (result.difference is None or one.field != "command")]
    if not known:
        return result
    tick = known[0].tick
    details = [_detail(one) for one in known if one.tick == tick]
    robots = ", ".join(dict.fromkeys(one.robot for one in known if one.tick == tick))
    why = f"the applied input of {robots} is not its recorded command"
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
