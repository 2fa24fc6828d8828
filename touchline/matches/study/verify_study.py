"""Checks a study that was played: digests, results and recordings, and matches that are simulated again."""

from collections.abc import Container, Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pandas as pd

from touchline.matches.engine.outcome import Outcome
from touchline.matches.engine.progress import ProgressDisplay
from touchline.matches.engine.verify import Depth, ResultRow, sampled, verify_run
from touchline.matches.series.plan import SeedMatch
from touchline.matches.study.digests import file_digest, library_digest, team_digests
from touchline.matches.study.match_figures import FIRST, SECOND
from touchline.matches.study.recording_functions import load_functions, measure
from touchline.matches.study.study_folder import CSV, DIGESTS, PARQUET, StoredStudy, csv_bytes, read_study
from touchline.matches.study.study_plan import recording_name


@dataclass(frozen=True, slots=True)
class StudyVerdict:
    """What was found."""

    faults: list[str]
    """One line for each thing that does not fit; empty if all fits."""
    notes: list[str]
    """What differs without being a fault, such as another version of this library."""
    played_again: int
    """Matches that were simulated again from their recordings, or played again."""
    byte_identical: bool | None
    """Whether the whole table of results is the same to the byte; None if not all figures were computed again."""


def verify_study(
    folder: Path,
    executor: Executor,
    sample: int | None,
    brain_folder: Path | None,
    progress: ProgressDisplay | None = None,
    *,
    from_recordings: bool = True,
) -> StudyVerdict:
    """Check the files of a study, and simulate a random sample of its matches again, or all of them.

    Args:
        folder: the study's.
        executor: where matches are simulated.
        sample: number of matches; None for all.
        brain_folder: where brains and functions are looked for; None as then.
        progress: shows each match that was checked.
        from_recordings: simulate a match from its recording, where there is one, instead of playing it again.

    Raises:
        TouchlineError: the folder has no study that was played.
    """
    stored = read_study(folder)
    home = brain_folder or stored.plan.brain_folder
    functions = load_functions(stored.plan.study.functions, home)
    faults = list(_table_faults(stored))
    depth, outcomes = Depth(recordings=bool(functions), failures=True), dict[str, Outcome]()
    with TemporaryDirectory() as scratch:
        plan = replace(stored.plan, brain_folder=home, folder=Path(scratch), measured={})
        matches = {match.identity: match for match in plan.matches(stored.seeds)}
        rows = dict(_rows(stored, matches.values(), from_recordings=from_recordings))
        chosen = sampled([match.planned for match in matches.values()], sample)
        unread = {recording_name(one) for one in matches} - {recording_name(one.identity) for one in chosen}
        faults = [*_file_faults(stored, unread), *faults]
        for check in verify_run(chosen, rows, folder, executor, depth, progress):
            faults += [f"{check.label}: {fault}" for fault in check.faults]
            if check.again is not None:
                outcomes[check.identity] = check.again
                if functions and check.again.recording is not None:
                    plan.measured[check.identity] = measure(functions, Path(check.again.recording))
        again = plan.table(stored.seeds, outcomes)
    newer = [name for name in again.columns if name not in stored.table.columns]
    again = again.drop(columns=newer)
    faults += [
        fault
        for planned in chosen
        if planned.identity in rows and planned.identity in outcomes
        for fault in _figure_faults(matches[planned.identity], stored.table, again)
    ]
    whole = None
    if sample is None and len(outcomes) == len(rows):
        whole = csv_bytes(again) == (folder / CSV).read_bytes()
        if not whole and not faults:
            faults.append(f"{CSV} differs from the table of the matches that were simulated again")
    notes = [*_notes(stored, home), *(f"{name} is a figure that the study does not have" for name in newer)]
    return StudyVerdict(faults, notes, len(chosen), whole)


def _rows(
    stored: StoredStudy, matches: Iterable[SeedMatch], *, from_recordings: bool
) -> Iterator[tuple[str, ResultRow]]:
    """The identities of the matches that have a row, and what it says."""
    known = set(zip(stored.table["identity"], stored.table["swapped"], strict=True))
    for match in matches:
        if (match.identity, match.swapped) not in known:
            continue
        row, path = _row(stored.table, match), recording_name(match.identity)
        goals = pd.to_numeric(pd.Series([row.get(f"{team}.goals") for team in (FIRST, SECOND)]), errors="coerce")
        counted = dict(zip(match.sides, goals.fillna(0).astype(int), strict=True))
        recorded = from_recordings and (stored.folder / path).exists()
        yield match.identity, ResultRow(str(row["chain"]), counted, path if recorded else None)


def _file_faults(stored: StoredStudy, unread: Container[str]) -> Iterator[str]:
    """Files that are missing or have changed; the content of `unread` ones is not looked at."""
    for name, digest in stored.digests["files"].items():
        path = stored.folder / name
        if not path.exists():
            yield f"{name} is missing, and is listed in {DIGESTS}"
        elif name not in unread and file_digest(path) != digest:
            yield f"{name} was changed after the study: its digest is not that in {DIGESTS}"


def _table_faults(stored: StoredStudy) -> Iterator[str]:
    """CSV and Parquet have the same values, and each row is of a match of the plan."""
    path = stored.folder / PARQUET
    try:
        if path.exists() and csv_bytes(pd.read_parquet(path)) != (stored.folder / CSV).read_bytes():
            yield f"{PARQUET} and {CSV} have different values"
    except Exception:  # whatever pandas and pyarrow make of it
        yield f"{PARQUET} is damaged"
    planned = {match.identity for match in stored.plan.matches(stored.seeds)}
    for row in stored.table.itertuples():
        if row.identity not in planned:
            yield f"{CSV}: cell {row.cell}, seed {row.seed}: {row.identity} is no match of the plan"


def _figure_faults(match: SeedMatch, rows: pd.DataFrame, again: pd.DataFrame) -> Iterator[str]:
    """The figures of a match are those of the table; its hash chain is not compared here."""
    stored_row, new = _row(rows, match), _row(again, match)
    different = [name for name in new.index if name != "chain" and not _equal(stored_row.get(name), new[name])]
    if different:
        name = different[0]
        more = f", and {len(different) - 1} more figures" if len(different) > 1 else ""
        values = f"{stored_row.get(name)} in {CSV} and {new[name]} when simulated again{more}"
        yield f"{match.planned.label}: {name} is {values}"


def _row(table: pd.DataFrame, match: SeedMatch) -> "pd.Series[Any]":
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
