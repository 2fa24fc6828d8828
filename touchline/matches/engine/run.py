"""Plays a plan to its end on an executor, and stores each outcome as soon as it is there."""

from collections import Counter
from collections.abc import Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any, Protocol

from schemas.errors import TouchlineError
from touchline.matches.engine.child_processes import DiedProcessError
from touchline.matches.engine.in_process import outcome_of_death
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome
from touchline.matches.engine.outcomes import Outcomes
from touchline.matches.engine.plan import Plan
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.worker import Delivery, play_here, play_on_worker

_ATTEMPTS = 3
"""How often a run begins a match whose process or machine is lost. One that is lost again is probably the reason."""


class Reporter(Protocol):
    """Shows how far a run is."""

    def planned(self, done: int, due: int) -> None:
        """`due` matches can be played now, with those that are being played; `done` have ended."""

    def ended(self, planned: PlannedMatch, outcome: Outcome) -> None:
        """A match has ended."""


class Store(Protocol):
    """Where outcomes are kept."""

    @property
    def folder(self) -> Path:
        """The folder of the run."""

    def outcomes(self) -> Outcomes:
        """Identity → outcome of all matches that have ended."""

    def add(self, outcome: Outcome, wall_s: float, worker: str) -> None:
        """Store an outcome."""

    def forget_lost(self) -> None:
        """Remove the outcomes of matches whose worker was lost, so that they are played again."""


@dataclass(frozen=True, slots=True)
class Remote:
    """The workers have other disks than this machine."""

    keep: Path | None = None
    """The folder on a worker's machine in which recordings stay; by default they are brought back."""


def run_plan(
    plan: Plan,
    executor: Executor,
    store: Store,
    report: Reporter,
    *,
    remote: Remote | None = None,
    at_once: int | None = None,
) -> Outcomes:
    """Play due matches until none is left; returns all outcomes, including earlier ones.

    An interruption leaves what is stored: the next call goes on from there. It plays matches again that have failed
    because their workers were lost.

    Args:
        plan: which matches are due.
        executor: where they are played.
        store: the state of the run.
        report: is told of each match that has ended.
        remote: for executors whose workers do not see the folder of the run.
        at_once: most matches that the executor is given at a time; None for all that are due.
    """
    store.forget_lost()
    outcomes = store.outcomes()
    running: dict[Future[Any], PlannedMatch] = {}
    lost: Counter[str] = Counter()
    while True:
        begun = {one.identity for one in running.values()}
        due = plan.due(outcomes)
        report.planned(len(outcomes), len(due))
        waiting = (one for one in due if one.identity not in begun)
        for planned in islice(waiting, None if at_once is None else at_once - len(running)):
            running[_submitted(planned, executor, store.folder, remote)] = planned
        if not running:
            return outcomes
        done = wait(running, return_when=FIRST_COMPLETED).done
        for future in [one for one in running if one in done]:
            planned = running.pop(future)
            delivery = _delivered(future, planned)
            outcome = _relative(delivery.outcome, store.folder)
            if isinstance(outcome, Failed) and outcome.kind is FailureKind.WORKER:
                lost[planned.identity] += 1
                if lost[planned.identity] < _ATTEMPTS:
                    continue  # it is due still
            _write(delivery.files, store.folder)
            store.add(outcome, delivery.wall_s, delivery.worker)
            outcomes[planned.identity] = outcome
            report.ended(planned, outcome)


def _submitted(planned: PlannedMatch, executor: Executor, folder: Path, remote: Remote | None) -> "Future[Any]":
    if remote is None:
        return executor.submit(play_here, planned)
    home = planned.brain_folder.absolute() if planned.brain_folder is not None else None
    return executor.submit(play_on_worker, replace(planned, brain_folder=home), folder, remote.keep)


def _delivered(future: "Future[Any]", planned: PlannedMatch) -> Delivery:
    """What an executor has returned; a match whose process or machine is lost has failed."""
    try:
        delivery: Delivery = future.result()
    except DiedProcessError as error:
        return Delivery(outcome_of_death(planned, error))
    except TouchlineError:
        raise
    except Exception as error:  # of any library that runs workers: Dask's KilledWorker, a broken pool, an import
        reason = f"its worker failed: {type(error).__name__}: {' '.join(str(error).split())}".rstrip(": ")
        return Delivery(Failed(planned.identity, FailureKind.WORKER, reason))
    return delivery


def _relative(outcome: Outcome, folder: Path) -> Outcome:
    """The outcome with paths that hold where the folder of the run is moved; those outside of it stay."""
    if isinstance(outcome, Failed):
        return replace(outcome, evidence=_relative_path(outcome.evidence, folder))
    return replace(outcome, recording=_relative_path(outcome.recording, folder))


def _relative_path(path: str | None, folder: Path) -> str | None:
    if path is None or not Path(path).resolve().is_relative_to(folder.resolve()):
        return path
    return Path(path).resolve().relative_to(folder.resolve()).as_posix()


def _write(files: Mapping[str, bytes], folder: Path) -> None:
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
