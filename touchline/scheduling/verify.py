"""Checks a finished run: simulates recordings again, and compares what its table says with them."""

import random
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor, as_completed
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from recordings.reading.recording import open_recording
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.messages.applied import Applied
from schemas.side import Side
from schemas.topics import APPLIED
from touchline.scheduling.child_processes import DiedProcessError, Poll
from touchline.scheduling.code_digest import code_digest
from touchline.scheduling.inputs_only import has_inputs_only
from touchline.scheduling.measurement import measured
from touchline.scheduling.outcome import Failed, Outcome, Played
from touchline.scheduling.planned_match import PlannedMatch
from touchline.scheduling.play import play
from touchline.verify.resimulate import verify


@dataclass(frozen=True, slots=True)
class MatchCheck:
    """What was found about one match."""

    identity: str
    label: str
    faults: tuple[str, ...]
    """Sentences on what does not fit; empty if all does."""
    ticks: int = 0
    """Number of ticks that were simulated again."""


@dataclass(frozen=True, slots=True)
class Depth:
    """How much of a match is checked; its result is compared with its recording in any case."""

    again: bool = True
    """It is simulated or played again."""
    code: bool = True
    """The files of its teams are compared with their digests."""


def sampled(matches: list[PlannedMatch], number: int | None, seed: int = 1) -> list[PlannedMatch]:
    """So many of the matches, drawn at random; all without a number."""
    if number is None or number >= len(matches):
        return matches
    drawn = set(random.Random(seed).sample(range(len(matches)), number))
    return [one for place, one in enumerate(matches) if place in drawn]


def verify_run(
    matches: list[PlannedMatch],
    outcomes: Mapping[str, Outcome],
    folder: Path,
    executor: Executor,
    depth_of: Callable[[PlannedMatch], Depth] = lambda _: Depth(),
) -> Iterator[MatchCheck]:
    """Check each match on the executor; yields each check when it is there.

    A match with a recording is simulated again from that. One without is played again, in the way it was planned.
    """
    futures = {
        executor.submit(check_match, one, outcomes.get(one.identity), folder, depth_of(one)): one for one in matches
    }
    for future in as_completed(futures):
        try:
            yield future.result()
        except DiedProcessError as error:
            planned = futures[future]
            yield MatchCheck(planned.identity, planned.label, (f"it could not be checked: {error}",))


def check_match(
    planned: PlannedMatch,
    outcome: Outcome | None,
    folder: Path,
    depth: Depth | None = None,
    poll: Poll = lambda: None,
) -> MatchCheck:
    """Check one match against its files; `poll` is called while it is played again."""
    depth = depth or Depth()
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
    ticks = 0
    if outcome.recording is not None:
        ticks, more = _check_recording(folder / outcome.recording, planned, outcome, again=depth.again)
        faults += more
    elif depth.again and not faults:
        faults += _check_again(planned, outcome, poll)
    return MatchCheck(planned.identity, planned.label, tuple(faults), ticks)


def _check_recording(path: Path, planned: PlannedMatch, outcome: Played, *, again: bool) -> tuple[int, list[str]]:
    """The number of ticks that were simulated again, and what differs."""
    try:
        recorded = open_recording(path).manifest.config
        ticks, faults = _simulated(path) if again else (0, [])
        if recorded is None or _compared(recorded) != _compared(planned.config):
            faults.append("it is the recording of another match: its configuration is not that of the plan")
        faults += _result_faults(path, planned, outcome)
    except TouchlineError as error:
        return 0, [str(error)]
    return ticks, faults


def _compared(config: MatchConfig) -> dict[str, Any]:
    return config.model_dump(exclude={"record", "patience"})


def _simulated(path: Path) -> tuple[int, list[str]]:
    verdict = verify(path)
    if verdict.difference is not None:
        why = f"tick {verdict.difference.tick} is the first that differs: {verdict.difference.why}"
        return verdict.ticks, [why]
    if not verdict.identical:
        return verdict.ticks, ["; ".join(verdict.contradictions) or "not all of its ticks could be compared"]
    return verdict.ticks, []


def _result_faults(path: Path, planned: PlannedMatch, outcome: Played) -> list[str]:
    """What differs between the outcome in the table and that of the recording."""
    if has_inputs_only(planned.config):
        chain = _last_chain(path)
        return [_other_chain(chain, outcome)] if chain != outcome.chain else []
    recorded = measured(path, planned.identity)
    if recorded.chain != outcome.chain:
        return [_other_chain(recorded.chain, outcome)]
    if recorded.goals != outcome.goals:
        return [f"{_score(recorded.goals)} is recorded, and {_score(outcome.goals)} in the table"]
    if recorded.figures != outcome.figures:
        return ["its figures are not those of its recording, such as cards and penalties"]
    return []


def _other_chain(chain: str, outcome: Played) -> str:
    return f"its hash chain ends with {chain}, that of the table with {outcome.chain}"


def _check_again(planned: PlannedMatch, outcome: Played, poll: Poll) -> list[str]:
    """Play a match again that has left no recording."""
    again = play(replace(planned, logs=None, recording=None), poll)
    if isinstance(again, Failed):
        return [f"played again, it failed: {again.reason}"]
    if again.chain != outcome.chain or again.goals != outcome.goals:
        return [f"played again, it ended {_score(again.goals)}, and {_score(outcome.goals)} is in the table"]
    return []


def _last_chain(path: Path) -> str:
    last = ""
    for _, message in open_recording(path).decoded(APPLIED.key):
        assert isinstance(message, Applied)
        last = message.chain
    return last


def _score(goals: Mapping[Side, int]) -> str:
    return f"{goals[Side.CYAN]} : {goals[Side.MAGENTA]}"
