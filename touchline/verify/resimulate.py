"""Verifies a recording: simulates it again and compares it tick by tick, by means of `recordings` and `sim_host`.

The recording has the applied inputs of each tick; the world part of the simulation repeats them, and the referee judges
them again. A segment that begins with a checkpoint does not depend on earlier ticks, so several processes verify
segments in parallel.
"""

import math
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from recordings.container.manifest import KeyCount
from recordings.inspection.contradictions import contradictions, record_faults
from recordings.reading.recorded_config import config_of
from recordings.reading.recording import Recording, open_recording
from recordings.reading.tick_index import Segment, TickIndex, tick_index_of
from runtime.process.clock import WallClock
from schemas.errors import TouchlineError
from schemas.topics import WORLD
from sim_host.games import game_of_recording
from sim_host.physics.fingerprint import fingerprint
from touchline.verify.recorded_keys import is_recorded, not_checked
from touchline.verify.segment_check import SegmentResult, resimulate_segment
from touchline.verify.verdict import Verdict

_WORTH_A_PROCESS = 1500
"""Cost of starting a process, in simulated ticks."""


def verify(path: Path, from_kick_off: int | None = None, processes: int = 1, referee: bool | None = None) -> Verdict:
    """Simulate a recording again and compare every tick, from tick 0 or from the kick-off of this number.

    With `referee`, the referee is simulated, too; by default where the recording has what that requires, and does not
    bring the program of a score.

    Raises:
        TouchlineError: not a recording, too few kick-offs, no tick can be simulated again, or `referee` is demanded of
            a recording without its settings.
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
    why_no_referee = _why_no_referee(recording, referee)
    if referee and why_no_referee:
        raise TouchlineError(f"{path}: the referee cannot be simulated: {why_no_referee}; verify with --no-referee")
    verdict = Verdict(
        kick_offs=len(index.kick_offs),
        processes=min(processes, len(segments)),
        other_machine=_other_machine(recording),
        other_program="" if why_no_referee else _other_program(recording),
        left_out=list(index.skipped(since)),
        referee=not why_no_referee,
        contradictions=[*contradictions(recording), *record_faults(recording)],
        not_checked=not_checked(recording, referee=not why_no_referee, why_no_referee=why_no_referee),
    )
    if index.unreadable:
        verdict.contradictions.append(f"host/applied: {index.unreadable} messages are invalid, doubled or out of order")
    for segment, result in zip(segments, _all(path, segments, verdict), strict=True):
        verdict.ticks += result.ticks
        verdict.without_world += result.without_world
        verdict.seconds += (segment.seconds[1] - segment.seconds[0]) * result.ticks / max(1, len(segment.ticks))
        verdict.difference = result.difference
        if verdict.difference is not None:
            break
    verdict.contradictions += _missing_worlds(recording, verdict.without_world)
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


def _missing_worlds(recording: Recording, missing: int) -> list[str]:
    """A sentence if more worlds are missing than were lost: a batch that is lost has no other message of its ticks."""
    result = recording.result
    if result is None or not is_recorded(recording, WORLD.key):
        return []
    lost = result.keys.get(WORLD.key, KeyCount()).lost
    return [f"{missing} ticks have no world, and {lost} were lost"] if missing > lost else []


def _why_no_referee(recording: Recording, wanted: bool | None) -> str:
    """Why the referee is not simulated; empty if it is."""
    if wanted is False:
        return "--no-referee"
    config = config_of(recording)
    if game_of_recording(config, recording.manifest.setup) is None:
        return "the recording has neither its match file nor a setup with the referee's settings"
    if config is not None and config.task is not None and not wanted:
        return "its score is a program in the recording, which --referee runs"
    return ""


def _other_machine(recording: Recording) -> dict[str, tuple[str, str]]:
    """The parts of the fingerprint that differ between the recording's machine and this one."""
    setup = recording.manifest.setup
    theirs, ours = setup.engine if setup is not None else {}, fingerprint()
    return {part: (value, ours[part]) for part, value in theirs.items() if part in ours and value != ours[part]}


def _other_program(recording: Recording) -> str:
    """The program that recorded the match, if its referee is not this one's; else empty."""
    manifest, setup = recording.manifest, recording.manifest.setup
    game = game_of_recording(config_of(recording), setup)
    if setup is None or game is None or game.fingerprint().items() <= setup.engine.items():
        return ""
    program = f"touchline {manifest.versions.get('touchline', 'of then')}"
    return f"recorded by a program with another referee: {program} of {manifest.started[:10]} verifies it"


def _all(path: Path, segments: list[Segment], verdict: Verdict) -> Iterable[SegmentResult]:
    """Yield the result of each segment, in sequence or by several processes; the caller stops at a difference."""
    if verdict.processes == 1:
        for segment in segments:
            yield resimulate_segment(path, segment, verdict.referee)
        return
    with ProcessPoolExecutor(verdict.processes, mp_context=get_context("spawn")) as pool:
        yield from pool.map(resimulate_segment, [path] * len(segments), segments, [verdict.referee] * len(segments))
