"""Verifies a cup: each result is that of its recording, and the recording can be simulated again."""

import random
from contextlib import closing
from dataclasses import asdict
from pathlib import Path

from recordings.reading.recording import open_recording
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from touchline.tournament.cup_state import CupMatch, MatchState
from touchline.tournament.playing.in_process import recorded_outcome
from touchline.tournament.playing.outcome import Outcome
from touchline.tournament.playing.planned_match import match_config
from touchline.tournament.playing.run_cup import stored_state
from touchline.tournament.playing.store import CupStore
from touchline.verify.resimulate import verify


def verify_cup(folder: Path, jobs: int, sample: int = 0) -> tuple[list[str], int]:
    """One line for each match that does not fit, and the number of matches that were simulated again.

    `sample` is the number of matches to simulate, drawn at random; 0 for all. Results are compared for all matches.

    Raises:
        TouchlineError: the folder has no cup.
    """
    with closing(CupStore(folder, writes=False)) as store:
        cup = store.cup
        if cup is None:
            raise TouchlineError(f"{folder}: its cup has not begun; nothing can be verified")
        state, outcomes = stored_state(cup, store), store.outcomes
    known = {one.slot.name for one in state.matches}
    faults = [f"{name}: the cup has no such match" for name in outcomes if name not in known]
    played = [one for one in state.matches if one.state is MatchState.PLAYED]
    for one in played:
        fault = _fault_of_recording(one, folder, match_config(cup, one.slot), outcomes[one.slot.name][1])
        faults += [f"{one.slot.name}: {fault}"] if fault else []
    chosen = random.sample(played, sample) if 0 < sample < len(played) else played
    for one in chosen:
        fault = _fault_of_simulation(one, folder, jobs)
        faults += [f"{one.slot.name}: {fault}"] if fault else []
    return faults, len(chosen)


def _path(one: CupMatch, folder: Path) -> Path:
    assert one.ended is not None
    return folder / (one.ended.recording or "")


def _fault_of_recording(one: CupMatch, folder: Path, config: MatchConfig, stored: Outcome) -> str | None:
    """What differs between a result, its match in the plan of the cup, and its recording."""
    try:
        recording = open_recording(_path(one, folder))
        recorded = recorded_outcome(recording)
    except TouchlineError as error:
        return str(error)
    if recording.manifest.config != config:
        return "its recording is of another match than the cup plans"
    for key, value in asdict(recorded).items():
        if asdict(stored)[key] != value:
            return f"its result is not that of its recording: {key} is {asdict(stored)[key]}, {value} is recorded"
    return None


def _fault_of_simulation(one: CupMatch, folder: Path, jobs: int) -> str | None:
    """Where the recording differs from the match that is simulated again."""
    try:
        verdict = verify(_path(one, folder), None, jobs, None)
    except TouchlineError as error:
        return str(error)
    if verdict.difference is not None:
        return f"tick {verdict.difference.tick} differs from the recording: {verdict.difference.why}"
    return None if verdict.identical else "; ".join(verdict.contradictions) or "it cannot be simulated again"
