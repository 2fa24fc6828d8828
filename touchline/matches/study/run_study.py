"""Runs a study to its end on an executor, and writes results and report."""

import json
import shutil
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from schemas.errors import MatchFailedError, TouchlineError
from touchline.launch.terminal.agent_faults import disturbance
from touchline.matches.engine.outcome import Failed, Outcome, Played
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.progress import ProgressDisplay
from touchline.matches.engine.run import run_plan
from touchline.matches.engine.store import RunStore
from touchline.matches.study.digests import as_text, library_digest, team_digests, versions
from touchline.matches.study.recording_functions import load_functions, measure
from touchline.matches.study.report import report_of
from touchline.matches.study.study_folder import REPORT, VERSIONS, write_digests, write_plan, write_results
from touchline.matches.study.study_plan import StudyPlan
from touchline.matches.study.team_checks import check_study_teams

_CODE = "code"
"""Name of the document with the digests of all code, in the state of a run."""


@dataclass(frozen=True, slots=True)
class StudyResult:
    """What a study came to."""

    seeds: list[int]
    played: int
    failed: list[Failed]
    disturbed: list[str]
    """Identities of matches that depend on more than their seeds, with the reason."""


def run_study(
    plan: StudyPlan,
    folder: Path,
    executor: Executor,
    sentence_of: Callable[[PlannedMatch, Outcome], str],
    progress: ProgressDisplay | None = None,
    *,
    fresh: bool = False,
    is_remote: bool = False,
) -> StudyResult:
    """Play all matches of a study that have no outcome in its folder, and write what the folder is to have.

    Raises:
        TouchlineError: a team or a function cannot be loaded, or the folder has the results of another plan.
        MatchFailedError: no match was played to its end.
    """
    functions = load_functions(plan.study.functions, plan.brain_folder)
    engine = check_study_teams(plan)
    code = {"touchline": library_digest(), **team_digests(plan.cells, plan.brain_folder)}
    with closing(RunStore(folder)) as store:
        write_plan(folder, plan)
        (folder / VERSIONS).write_text(as_text(versions(engine)), "utf-8")
        if fresh:
            store.forget_all()
        _check_code(store, code)

        def told(planned: PlannedMatch, outcome: Outcome) -> str:
            _measure(plan, folder, functions, outcome)
            if isinstance(outcome, Played) and planned.logs is not None:
                shutil.rmtree(planned.logs, ignore_errors=True)
            return sentence_of(planned, outcome)

        for outcome in store.outcomes().values():
            _measure(plan, folder, functions, outcome)
        outcomes = run_plan(plan, executor, store, told, progress, is_remote=is_remote)
    seeds = plan.seeds_due(outcomes)
    of_plan = [outcomes[match.identity] for match in plan.matches(seeds)]
    failed = [one for one in of_plan if isinstance(one, Failed)]
    missed = {one.identity: one.missed for one in of_plan if isinstance(one, Played) and one.missed}
    if len(failed) == len(plan.matches(seeds)):
        raise MatchFailedError(f"all {len(failed)} matches failed: {failed[0].reason}; mend it and run with --fresh")
    table = plan.table(seeds, outcomes)
    write_results(folder, table)
    (folder / REPORT).write_text(report_of(plan, table, seeds, failed, versions(engine)), "utf-8")
    write_digests(folder, seeds, code)
    return StudyResult(seeds, len(table), failed, [f"{name}: {disturbance(by)}" for name, by in missed.items()])


def _measure(plan: StudyPlan, folder: Path, functions: Mapping[str, Callable[..., Any]], outcome: Outcome) -> None:
    """Apply the study's functions to the recording of a match that was played.

    Raises:
        TouchlineError: it has none, because the study had no functions then, or one of them fails.
    """
    if functions and isinstance(outcome, Played):
        if outcome.recording is None:
            raise TouchlineError(f"{folder}: functions need recordings of all matches; play all again with --fresh")
        plan.measured[outcome.identity] = measure(functions, folder / outcome.recording)


def _check_code(store: RunStore, code: Mapping[str, str]) -> None:
    """Check that no result of other code is in the folder."""
    then = json.loads(store.document(_CODE) or "{}")
    changed = [name for name, digest in code.items() if name in then and then[name] != digest]
    if changed and store.outcomes():
        raise TouchlineError(
            f"{store.folder} has results of other code of {changed[0]}; play all again with --fresh, or give another "
            "folder with --out"
        )
    store.set_document(_CODE, as_text(dict(code)))
