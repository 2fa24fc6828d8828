"""Runs a study to its end: plays what is due, stores each outcome at once, and writes results and report."""

from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from schemas.errors import MatchFailedError
from touchline.experiment.digests import as_text, library_digest, team_digests, versions
from touchline.experiment.match_outcome import FailedMatch, MatchOutcome
from touchline.experiment.outcome_store import open_store
from touchline.experiment.play_match import MatchTask, function_of, play_task
from touchline.experiment.report import report_of
from touchline.experiment.result_table import result_table
from touchline.experiment.study_folder import (
    REPORT,
    STATE,
    VERSIONS,
    recording_name,
    write_digests,
    write_plan,
    write_results,
)
from touchline.experiment.study_plan import StudyMatch, StudyPlan
from touchline.play import InProcessMatch
from touchline.series.processes import DiedProcess, run_in_processes

MOST_ATTEMPTS = 3
"""How often a match is played whose process dies before it becomes a failed match. Chosen here."""

Ended = Callable[[StudyMatch, MatchOutcome], None]
"""Called with each match that has ended, and its outcome."""


@dataclass(frozen=True, slots=True)
class StudyResult:
    """What a study came to."""

    seeds: list[int]
    played: int
    failed: list[FailedMatch]


def run_study(
    plan: StudyPlan, folder: Path, brain_folder: Path | None, jobs: int, ended: Ended, *, resumed: bool = True
) -> StudyResult:
    """Play all matches of a study that have no outcome in its folder, and write what the folder is to have.

    Raises:
        TouchlineError: a team or a function cannot be loaded, or the folder has the results of another plan.
        MatchFailedError: no match was played to its end.
    """
    engine = _engine(plan, brain_folder)
    write_plan(folder, plan, brain_folder)
    if not resumed:
        (folder / STATE).unlink(missing_ok=True)
    (folder / VERSIONS).write_text(as_text(versions(engine)), "utf-8")
    with open_store(folder / STATE) as store:
        outcomes = store.outcomes()
        while due := plan.due(outcomes):
            for match, outcome in play_matches(plan, due, folder, brain_folder, jobs):
                store.add(outcome)
                outcomes[outcome.identity] = outcome
                ended(match, outcome)
    seeds = plan.seeds_due(outcomes)
    failed = _failed(plan, seeds, outcomes)
    if len(failed) == len(plan.matches(seeds)):
        raise MatchFailedError(f"all {len(failed)} matches failed: {failed[0].reason}; mend it and run with --fresh")
    write_results(folder, plan, seeds, outcomes)
    table = result_table(plan, seeds, outcomes)
    (folder / REPORT).write_text(report_of(plan, table, seeds, failed, versions(engine)), "utf-8")
    code = {"touchline": library_digest(), **team_digests(plan.cells, brain_folder)}
    write_digests(folder, seeds, code)
    return StudyResult(seeds, len(table), failed)


def play_matches(
    plan: StudyPlan, matches: Iterable[StudyMatch], folder: Path | None, brain_folder: Path | None, jobs: int
) -> Generator[tuple[StudyMatch, MatchOutcome], None, None]:
    """Play matches in up to `jobs` processes; recordings go to `folder` if the study wants them.

    A match whose process dies is played again, up to `MOST_ATTEMPTS` times.
    """
    keeps = folder is not None and plan.study.record
    tasks = [_task(plan, match, folder if keeps else None, brain_folder) for match in matches]
    for attempt in range(1, MOST_ATTEMPTS + 1):
        died = list[MatchTask]()
        with closing(run_in_processes(play_task, tasks, jobs)) as results:
            for task, result in results:
                if not isinstance(result, DiedProcess):
                    yield task.match, result
                elif attempt == MOST_ATTEMPTS:
                    yield task.match, FailedMatch(task.match.identity, f"{result.reason}, {attempt} times")
                else:
                    died.append(task)
        tasks = died


def _task(plan: StudyPlan, match: StudyMatch, folder: Path | None, brain_folder: Path | None) -> MatchTask:
    recording = folder / recording_name(match.identity) if folder is not None else None
    return MatchTask(match, brain_folder, plan.study.functions, recording)


def _engine(plan: StudyPlan, brain_folder: Path | None) -> dict[str, str]:
    """The fingerprint of the engine; builds each cell's first match, so that an error is reported before any is played.

    Raises:
        TouchlineError: a team or a function cannot be loaded, or a number is invalid.
    """
    for path in plan.study.functions.values():
        function_of(path, brain_folder)
    engine: dict[str, str] = {}
    for match in plan.matches(plan.study.first_seeds[:1]):
        built = InProcessMatch(match.config, brain_folder=brain_folder)
        engine = built.simulation.setup().engine
        built.close()
    return engine


def _failed(plan: StudyPlan, seeds: Sequence[int], outcomes: Mapping[str, MatchOutcome]) -> list[FailedMatch]:
    of_plan = (outcomes[match.identity] for match in plan.matches(seeds))
    return [outcome for outcome in of_plan if isinstance(outcome, FailedMatch)]
