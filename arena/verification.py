"""A recording simulated again and compared, tick by tick: where `recordings` and `sim_host` meet.

The recording gives what was noted of each tick; the world part of the simulation goes the same way once more. Stretches
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

from arena.beginning import beginning
from recordings.answers import Contradiction
from recordings.course import Course, LeftOut, Stretch, TickNote, Why, answers_of, course_of, notes
from recordings.reader import Recording, open_recording
from schemas.errors import TouchlineError
from schemas.host import Applied, noted
from schemas.message import BadMessageError
from sim_host.resimulation import ImpossibleTickError, Resimulation, differences
from sim_host.world.engine import fingerprint

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
    left_out: list[LeftOut] = field(default_factory=list)
    without_world: int = 0
    """Ticks whose `world` was not recorded: of them the chain alone was compared."""

    @property
    def identical(self) -> bool:
        """Nothing differs, nothing is missing in between, and something was compared."""
        return self.ticks > 0 and self.difference is None and all(one.why is not Why.MISSING for one in self.left_out)

    def to_json(self) -> dict[str, Any]:
        """The verdict as plain lists, numbers and texts."""
        fields = asdict(self)
        fields["left_out"] = [one._asdict() for one in self.left_out]
        return {"identical": self.identical, **fields}


class _Retraced(NamedTuple):
    """What came of one stretch."""

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
    course = course_of(recording)
    since = _since(path, course, from_kick_off)
    whole = sum(1 for start in course.starts if start.tick >= since)
    worth = _WORTH_A_PROCESS if processes > 1 and whole > 1 else math.inf
    stretches = list(course.stretches(since, worth))
    if not stretches:
        raise TouchlineError(
            f"{path}: nothing in it can be simulated again; it takes what was applied at tick 0, or at a kick-off "
            "and the tick before (host/applied and world)"
        )
    verdict = Verdict(
        kick_offs=len(course.kick_offs),
        processes=min(processes, len(stretches)),
        other_machine=_other_machine(recording),
        left_out=list(course.left_out(since)),
    )
    for stretch, came in zip(stretches, _all(path, stretches, verdict.processes), strict=True):
        verdict.ticks += came.ticks
        verdict.without_world += came.without_world
        verdict.seconds += (stretch.seconds[1] - stretch.seconds[0]) * came.ticks / max(1, len(stretch.ticks))
        verdict.difference = came.difference
        if verdict.difference is not None:
            break
    verdict.took = time.perf_counter() - began
    return verdict


def _since(path: Path, course: Course, from_kick_off: int | None) -> int:
    if from_kick_off is None:
        return 0
    for start in course.kick_offs:
        if start.kick_off == from_kick_off:
            return start.tick
    there = len(course.kick_offs)
    says = f"{path} has {there} that it can begin with, counted from 1" if there else f"{path} has none to begin with"
    raise TouchlineError(f"--from-kickoff is {from_kick_off}; {says}")


def _other_machine(recording: Recording) -> dict[str, tuple[str, str]]:
    """What of the fingerprint differs between the machine that simulated the match and this one."""
    setup = recording.manifest.setup
    theirs, ours = setup.engine if setup is not None else {}, fingerprint()
    return {part: (told, ours[part]) for part, told in theirs.items() if part in ours and told != ours[part]}


def _all(path: Path, stretches: list[Stretch], processes: int) -> Iterable[_Retraced]:
    """What comes of each stretch, one after the other or by several processes; it is asked for up to a difference."""
    if processes == 1:
        for stretch in stretches:
            yield retrace(path, stretch)
        return
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        yield from pool.map(retrace, [path] * len(stretches), stretches)


def retrace(path: Path, stretch: Stretch) -> _Retraced:
    """Simulate one stretch again, up to the first tick that is not as it was recorded.

    Raises:
        TouchlineError: the recording is damaged, or does not say how the match was set up.
    """
    recording = open_recording(path)
    answers = answers_of(recording, stretch)
    first = stretch.ticks.start
    ticks = without_world = 0
    difference: Discrepancy | None = None
    again: Resimulation | None = None
    before: TickNote | None = None
    try:
        for note in notes(recording, stretch, answers):
            if note.tick < first:
                before = note
                continue
            try:
                again = again or Resimulation(*beginning(recording, stretch, before))
                applied: Applied = note.applied or note.recorded.message()  # which says what is wrong with it
                answers.applied(applied)
                difference = _compared(again, applied, note)
            except (BadMessageError, ImpossibleTickError) as error:
                difference = Discrepancy(note.tick, note.recorded.time, f"cannot have been: {error}")
            if difference is not None:
                break
            ticks += 1
            without_world += note.world is None
    finally:
        if again is not None:
            again.close()
    return _with_answers(_Retraced(ticks, without_world, difference), answers.contradictions(), stretch)


def _compared(again: Resimulation, applied: Applied, note: TickNote) -> Discrepancy | None:
    """One tick; nothing when it is as recorded."""
    tick = again.step(applied, noted(note.recorded.payload))
    found = differences(note.world, tick.bodies) if note.world is not None else []
    if not found and tick.chain == applied.chain:
        return None
    details = [Detail(one.body, one.field, one.recorded, one.simulated, one.by) for one in found]
    if tick.chain == applied.chain:
        why = "the hash chain is the same, the recorded world is another"
    elif found:
        why = "the world comes to another state"
    elif note.world is None:
        why = "the hash chain differs, and no world was recorded to compare"
    else:
        why = (
            "the hash chain differs and the world does not: what was noted of this tick was changed, "
            "or the ball's spin is another"
        )
    return Discrepancy(applied.tick, applied.time, why, details)


def _with_answers(came: _Retraced, contradictions: list[Contradiction], stretch: Stretch) -> _Retraced:
    """The same with inputs that are not the recorded commands, where they come first."""
    end = came.difference.tick if came.difference is not None else stretch.ticks.stop
    # where the stretch was left early, a command that is missing may have been yet to come
    known = [one for one in contradictions if one.tick <= end and (came.difference is None or one.field != "command")]
    if not known:
        return came
    tick = known[0].tick
    details = [_detail(one) for one in known if one.tick == tick]
    who = ", ".join(dict.fromkeys(one.robot for one in known if one.tick == tick))
    why = f"what {who} was told is not what its program said"
    if came.difference is not None and came.difference.tick == tick:
        why, details = f"{why}; {came.difference.why}", details + came.difference.details
    begins, ends = stretch.seconds
    share = (tick - stretch.ticks.start) / max(1, len(stretch.ticks) - 1)
    moment = begins + share * (ends - begins)
    return came._replace(ticks=tick - stretch.ticks.start, difference=Discrepancy(tick, moment, why, details))


def _detail(one: Contradiction) -> Detail:
    numbers = [value for value in (one.applied, one.sent) if isinstance(value, float)]
    by = abs(numbers[0] - numbers[1]) if len(numbers) == 2 else None
    return Detail(f"input of {one.robot}", one.field, one.applied, one.sent, by)
