"""Checks a finished run: simulates recordings again, and compares what its table says with them."""

import random
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from recordings.reading.recording import open_recording
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.messages.applied import Applied
from schemas.side import Side
from schemas.topics import APPLIED
from touchline.launch.processes.stop_signals import StopSignals
from touchline.matches.engine.code_digest import code_digest
from touchline.matches.engine.completions import Completions
from touchline.matches.engine.fresh_process import DiedProcessError
from touchline.matches.engine.inputs_only import has_inputs_only
from touchline.matches.engine.measurement import measured
from touchline.matches.engine.outcome import Failed, Played
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.play import play
from touchline.matches.engine.progress import ProgressDisplay
from touchline.verify.resimulate import verify


@dataclass(frozen=True, slots=True)
class ResultRow:
    """What a published table says of a match that was played, as an outcome does."""

    chain: str
    goals: Mapping[Side, int]
    recording: str | None = None
    """Path of its recording in the folder of the run; None to play the match again."""


Result = Played | ResultRow


@dataclass(frozen=True, slots=True)
class MatchCheck:
    """What was found about one match."""

    identity: str
    label: str
    faults: tuple[str, ...]
    """Sentences on what does not fit; empty if all does."""
    ticks: int = 0
    """Number of ticks that were simulated again."""
    again: Played | None = None
    """The outcome as its recording shows it, or of the match that was played again; None without either."""


def sampled(matches: list[PlannedMatch], number: int | None) -> list[PlannedMatch]:
    """So many of the matches, drawn at random: others each time, so that nobody knows which; all without a number."""
    if number is None or number >= len(matches):
        return matches
    drawn = set(random.SystemRandom().sample(range(len(matches)), number))
    return [one for place, one in enumerate(matches) if place in drawn]


@dataclass(frozen=True, slots=True)
class Depth:
    """What is checked of a match besides its result and its recording."""

    code: bool = True
    """The files of its teams are compared with their digests."""
    recordings: bool = False
    """A match that is played again leaves its recording where its plan says."""
    failures: bool = False
    """A match without an outcome has failed: it is played again, and fails again."""


def verify_run(
    matches: Sequence[PlannedMatch],
    outcomes: Mapping[str, Result | Failed],
    folder: Path,
    executor: Executor,
    depth: Depth | None = None,
    progress: ProgressDisplay | None = None,
) -> Iterator[MatchCheck]:
    """Check each match on the executor; yields each check when it is there, and shows it.

    A match with a recording is simulated again from that. One without is played again, in the way it was planned.
    """
    depth = depth or Depth()
    if progress is not None:
        progress.planned(0, len(matches))
    with StopSignals() as stop:
        ended = Completions(stop)
        futures = {executor.submit(check_match, one, outcomes.get(one.identity), folder, depth): one for one in matches}
        for future in futures:
            ended.add(future)
        for _ in matches:
            planned = futures[future := ended.next()]
            try:
                check: MatchCheck = future.result()
            except DiedProcessError as error:
                fails_again = depth.failures and planned.identity not in outcomes
                faults = () if fails_again else (f"it could not be checked: {error}",)
                check = MatchCheck(planned.identity, planned.label, faults)
            if progress is not None:
                progress.ended("; ".join((check.label, *check.faults)), failed=bool(check.faults))
            yield check


def check_match(
    planned: PlannedMatch,
    outcome: Result | Failed | None,
    folder: Path,
    depth: Depth | None = None,
    note: Path | None = None,
) -> MatchCheck:
    """Check one match against its files; `note` is that of `play`, for one that is played again."""
    depth = depth or Depth()
    if outcome is None and depth.failures:
        played = isinstance(play(replace(planned, logs=None), note), Played)
        found = ("has no result, and was played to its end again",) if played else ()
        return MatchCheck(planned.identity, planned.label, found)
    if outcome is None:
        return MatchCheck(planned.identity, planned.label, ("it was not played",))
    faults = [
        f"the files of {planned.config.team(side).name or side.value} have changed since then"
        for side, digest in planned.code.items()
        if depth.code and code_digest(planned.config, side, planned.brain_folder) != digest
    ]
    if isinstance(outcome, Failed):
        if outcome.evidence is not None and not (folder / outcome.evidence).exists():
            faults.append(f"its evidence {outcome.evidence} is gone")
        return MatchCheck(planned.identity, planned.label, tuple(faults))
    if outcome.recording is not None:
        ticks, more, again = _check_recording(folder / outcome.recording, planned, outcome)
    elif not faults:
        kept = planned if depth.recordings else replace(planned, recording=None)
        ticks, more, again = _check_again(kept, outcome, note)
    else:
        return MatchCheck(planned.identity, planned.label, tuple(faults))
    return MatchCheck(planned.identity, planned.label, (*faults, *more), ticks, again)


def _check_recording(path: Path, planned: PlannedMatch, outcome: Result) -> tuple[int, list[str], Played | None]:
    try:
        opened = open_recording(path)
        recorded = opened.manifest.config
        is_own = recorded is not None and _compared(recorded) == _compared(planned.config)
        runs_score = is_own and planned.config.task is not None  # the plan's own, not one that a recording brings
        ticks, faults = _simulated(path, runs_score=runs_score)
        if not is_own:
            faults.append("it is the recording of another match: its configuration is not that of the plan")
        again = None if has_inputs_only(planned.config) else measured(path, planned.identity)
        last: Applied | Played | None = again or opened.last(APPLIED.key)
        chain = last.chain if last is not None else ""
    except TouchlineError as error:
        return 0, [str(error)], None
    if chain != outcome.chain:
        faults.append(f"its hash chain ends with {chain}, that of the table with {outcome.chain}")
    if again is not None and again.goals != outcome.goals:
        faults.append(f"{_score(again.goals)} is recorded, and {_score(outcome.goals)} in the table")
    elif (
        again is not None
        and isinstance(outcome, Played)
        and (again.figures, again.value) != (outcome.figures, outcome.value)
    ):
        faults.append("its figures are not those of its recording, such as cards and penalties")
    return ticks, faults, again


def _compared(config: MatchConfig) -> dict[str, Any]:
    return config.model_dump(exclude={"record", "patience"})


def _simulated(path: Path, *, runs_score: bool) -> tuple[int, list[str]]:
    """The number of ticks that were simulated again, and the first that differs."""
    verdict = verify(path, referee=True if runs_score else None)
    if verdict.difference is not None:
        why = f"tick {verdict.difference.tick} is the first that differs: {verdict.difference.why}"
        return verdict.ticks, [why]
    if not verdict.identical:
        return verdict.ticks, ["; ".join(verdict.contradictions) or "not all of its ticks could be compared"]
    return verdict.ticks, []


def _check_again(planned: PlannedMatch, outcome: Result, note: Path | None) -> tuple[int, list[str], Played | None]:
    """Play a match again that has left no recording."""
    again = play(replace(planned, logs=None), note)
    if isinstance(again, Failed):
        return 0, [f"played again, it failed: {again.reason}"], None
    faults = []
    if again.goals != outcome.goals:
        faults.append(f"played again, it ended {_score(again.goals)}, and {_score(outcome.goals)} is in the table")
    if again.chain != outcome.chain:
        faults.append(f"played again, it was another match: its hash chain ends with {again.chain}")
    return 0, faults, again


def _score(goals: Mapping[Side, int]) -> str:
    return f"{goals[Side.CYAN]} : {goals[Side.MAGENTA]}"
