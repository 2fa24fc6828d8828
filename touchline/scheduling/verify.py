"""Checks a finished run: simulates recordings again, and compares what its table says with them."""

import random
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor, as_completed
from dataclasses import dataclass, replace
from pathlib import Path

from recordings.reading.recording import open_recording
from schemas.errors import TouchlineError
from schemas.messages.applied import Applied
from schemas.side import Side
from schemas.topics import APPLIED
from touchline.scheduling.child_processes import Poll
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


def sampled(matches: list[PlannedMatch], number: int | None, seed: int = 1) -> list[PlannedMatch]:
    """So many of the matches, drawn at random; all without a number."""
    if number is None or number >= len(matches):
        return matches
    drawn = set(random.Random(seed).sample(range(len(matches)), number))
    return [one for place, one in enumerate(matches) if place in drawn]


def verify_run(
    matches: list[PlannedMatch], outcomes: Mapping[str, Outcome], folder: Path, executor: Executor
) -> Iterator[MatchCheck]:
    """Check each match on the executor; yields each check when it is there.

    A match with a recording is simulated again from that. One without is played again, in the way it was planned.
    """
    futures = [executor.submit(check_match, one, outcomes.get(one.identity), folder) for one in matches]
    for future in as_completed(futures):
        yield future.result()


def check_match(planned: PlannedMatch, outcome: Outcome | None, folder: Path, poll: Poll = lambda: None) -> MatchCheck:
    """Check one match against its files; `poll` is called while it is played again."""
    if outcome is None:
        return MatchCheck(planned.identity, planned.label, ("it was not played",))
    faults = [
        f"the files of {planned.config.team(side).name or side.value} have changed since then"
        for side, digest in planned.code.items()
        if code_digest(planned.config, side, planned.brain_folder) != digest
    ]
    if isinstance(outcome, Failed):
        if outcome.evidence is not None and not (folder / outcome.evidence).exists():
            faults.append(f"its evidence {outcome.evidence} is gone")
        return MatchCheck(planned.identity, planned.label, tuple(faults))
    ticks = 0
    if outcome.recording is not None:
        ticks, more = _check_recording(folder / outcome.recording, planned, outcome)
        faults += more
    elif not faults:
        faults += _check_again(planned, outcome, poll)
    return MatchCheck(planned.identity, planned.label, tuple(faults), ticks)


def _check_recording(path: Path, planned: PlannedMatch, outcome: Played) -> tuple[int, list[str]]:

    try:
        recording = open_recording(path)
        verdict = verify(path)
    except TouchlineError as error:
        return 0, [str(error)]
    faults = []
    if verdict.difference is not None:
        faults.append(f"tick {verdict.difference.tick} is the first that differs: {verdict.difference.why}")
    elif not verdict.identical:
        faults.append("not all of its ticks could be compared")
    unlike = {"record", "patience"}
    recorded = recording.manifest.config
    if recorded is None or recorded.model_dump(exclude=unlike) != planned.config.model_dump(exclude=unlike):
        faults.append("it is the recording of another match: its configuration is not that of the plan")
    if has_inputs_only(planned.config):
        chain = _last_chain(path)
        goals: dict[Side, int] | None = None
    else:
        again = measured(path, planned.identity)
        chain, goals = again.chain, again.goals
    if chain != outcome.chain:
        faults.append(f"its hash chain ends with {chain}, that of the table with {outcome.chain}")
    if goals is not None and goals != outcome.goals:
        faults.append(f"{_score(goals)} is recorded, and {_score(outcome.goals)} in the table")
    return verdict.ticks, faults


def _check_again(planned: PlannedMatch, outcome: Played, poll: Poll) -> list[str]:
    """Play a match again that has left no recording."""
    again = play(replace(planned, logs=None), poll)
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
