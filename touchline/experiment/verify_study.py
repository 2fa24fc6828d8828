"""Checks a study that was played: digests, results and recordings, and matches that are played again."""

import random
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pandas as pd

from recordings.reading.recording import open_recording
from recordings.stats.match_statistics import figures_of_recording
from schemas.errors import TouchlineError
from touchline.experiment.digests import file_digest, library_digest, team_digests
from touchline.experiment.match_figures import by_team, flat_figures
from touchline.experiment.recording_functions import load_functions
from touchline.experiment.result_table import result_table
from touchline.experiment.run_study import Ended, play_measured
from touchline.experiment.study_folder import (
    CSV,
    DIGESTS,
    PARQUET,
    StoredStudy,
    csv_bytes,
    read_study,
)
from touchline.experiment.study_plan import RECORDINGS, StudyMatch, StudyPlan, recording_name
from touchline.scheduling.outcome import Failed, Outcome
from touchline.scheduling.plan import ListPlan
from touchline.scheduling.store import MemoryStore


@dataclass(frozen=True, slots=True)
class Verdict:
    """What was found."""

    faults: list[str]
    """One line for each thing that does not fit; empty if all fits."""
    notes: list[str]
    """What differs without being a fault, such as another version of this library."""
    played_again: int
    byte_identical: bool | None
    """Whether the whole table of results is the same to the byte; None if only a sample was played again."""


def verify_study(
    folder: Path, executor: Executor, sample: int | None, brain_folder: Path | None, ended: Ended
) -> Verdict:
    """Check the files of a study, and play a random sample of its matches again, or all of them.

    Raises:
        TouchlineError: the folder has no study that was played.
    """
    stored = read_study(folder)
    home = brain_folder or stored.plan.brain_folder
    faults = [*_file_faults(stored), *_table_faults(stored), *_recording_faults(stored)]
    distinct = {match.identity: match for match in stored.plan.matches(stored.seeds)}
    matches = list(distinct.values())
    chosen = matches if sample is None else random.Random(0).sample(matches, min(sample, len(matches)))
    with TemporaryDirectory() as scratch:
        plan = replace(stored.plan, brain_folder=home, recordings=Path(scratch), measured={})
        outcomes = _played_again(plan, chosen, Path(scratch), executor, ended)
    again = result_table(plan, stored.seeds, outcomes)
    faults += [
        fault for match in chosen for fault in _match_faults(match, outcomes[match.identity], stored.table, again)
    ]
    whole = None
    if sample is None:
        whole = csv_bytes(again) == (folder / CSV).read_bytes()
        if not whole and not faults:
            faults.append(f"{CSV} differs from the table of the matches that were played again")
    return Verdict(faults, _notes(stored, home), len(chosen), whole)


def _played_again(
    plan: StudyPlan, matches: Sequence[StudyMatch], folder: Path, executor: Executor, ended: Ended
) -> dict[str, Outcome]:
    functions = load_functions(plan.study.functions, plan.brain_folder)
    due = ListPlan(tuple(plan.planned(match) for match in matches))
    return play_measured(plan, due, MemoryStore(folder), executor, functions, ended)


def _file_faults(stored: StoredStudy) -> Iterator[str]:
    for name, digest in stored.digests["files"].items():
        path = stored.folder / name
        if not path.exists():
            yield f"{name} is missing, and is listed in {DIGESTS}"
        elif file_digest(path) != digest:
            yield f"{name} was changed after the study: its digest is not that in {DIGESTS}"


def _table_faults(stored: StoredStudy) -> Iterator[str]:
    """CSV and Parquet have the same values, and each row is of a match of the plan."""
    path = stored.folder / PARQUET
    if path.exists() and csv_bytes(pd.read_parquet(path)) != (stored.folder / CSV).read_bytes():
        yield f"{PARQUET} and {CSV} have different values"
    planned = {match.identity for match in stored.plan.matches(stored.seeds)}
    for row in stored.table.itertuples():
        if row.identity not in planned:
            yield f"{CSV}: cell {row.cell}, seed {row.seed}: {row.identity} is no match of the plan"


def _recording_faults(stored: StoredStudy) -> Iterator[str]:
    """The goals in the table are those in the recordings."""
    if not (stored.folder / RECORDINGS).exists():
        return
    known = set(stored.table["identity"])
    for match in stored.plan.matches(stored.seeds):
        path = stored.folder / recording_name(match.identity)
        if not path.exists() or match.identity not in known:
            continue
        try:
            figures = by_team(flat_figures(figures_of_recording(open_recording(path))), match.sides)
        except TouchlineError as error:
            yield f"{match.title}: {error}"
            continue
        row = _row(stored.table, match)
        for name in ("first.goals", "second.goals"):
            if row[name] != figures[name]:
                yield f"{match.title}: {name} is {row[name]:g} in {CSV} and {figures[name]} in {path.name}"


def _match_faults(match: StudyMatch, outcome: Outcome, rows: pd.DataFrame, again: pd.DataFrame) -> Iterator[str]:
    known = not rows.empty and match.identity in set(rows["identity"])
    if isinstance(outcome, Failed):
        if known:
            yield f"{match.title}: has a result, and failed when it was played again: {outcome.reason}"
        return
    if not known:
        yield f"{match.title}: has no result, and was played to its end again"
        return
    stored_row, new = _row(rows, match), _row(again, match)
    if stored_row["chain"] != new["chain"]:
        yield f"{match.title}: another match: hash chain {new['chain']} in place of {stored_row['chain']}"
    different = [name for name in new.index if name != "chain" and not _equal(stored_row.get(name), new[name])]
    if different:
        name = different[0]
        more = f", and {len(different) - 1} more figures" if len(different) > 1 else ""
        yield f"{match.title}: {name} is {stored_row.get(name)} in {CSV} and {new[name]} when played again{more}"


def _row(table: pd.DataFrame, match: StudyMatch) -> "pd.Series[Any]":
    is_row = (table["identity"] == match.identity) & (table["swapped"] == match.swapped)
    return table[is_row].iloc[0]


def _equal(one: Any, other: Any) -> bool:
    return bool(one == other or (pd.isna(one) and pd.isna(other)) or str(one) == str(other))


def _notes(stored: StoredStudy, home: Path | None) -> list[str]:
    here = {"touchline": library_digest(), **team_digests(stored.plan.cells, home)}
    then = stored.digests["code"]
    return [
        f"the code of {name} is not that of the study (digest {here.get(name, 'none')}, then {digest})"
        for name, digest in then.items()
        if here.get(name) != digest
    ]
