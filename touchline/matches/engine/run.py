"""Plays a plan to its end on an executor, and stores each outcome as soon as it is there."""

from collections import Counter
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, Future
from dataclasses import replace
from pathlib import Path
from typing import Any

from schemas.errors import TouchlineError
from touchline.launch.processes.stop_signals import StopSignals
from touchline.launch.terminal.agent_faults import disturbance
from touchline.matches.engine.completions import Completions
from touchline.matches.engine.fresh_process import DiedProcessError
from touchline.matches.engine.in_process import outcome_of_death
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, Played, relative_to
from touchline.matches.engine.plan import Plan
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.play import play
from touchline.matches.engine.progress import ProgressDisplay
from touchline.matches.engine.store import RunStore
from touchline.matches.engine.worker import play_in_fresh_process

_ATTEMPTS = 3
"""How often a run begins a match whose process or machine is lost. One that is lost again is probably the reason."""


def run_plan(
    plan: Plan,
    executor: Executor,
    store: RunStore | None,
    sentence_of: Callable[[PlannedMatch, Outcome], str],
    progress: ProgressDisplay | None = None,
    *,
    is_remote: bool = False,
) -> dict[str, Outcome]:
    """Play due matches until none is left; returns all outcomes, including earlier ones.

    An interruption leaves what is stored: the next call goes on from there. It plays matches again that have failed
    because their workers were lost. The main thread calls it.

    Args:
        plan: which matches are due.
        executor: where they are played.
        store: the state of the run; None for a run that nobody resumes.
        sentence_of: is called with each match that has ended, and returns what is shown of it.
        progress: shows how far the run is.
        is_remote: the workers do not see the folder of the run.

    Raises:
        KeyboardInterrupt: SIGINT or SIGTERM has come.
    """
    if store is not None:
        store.forget_lost()
    outcomes = store.outcomes() if store is not None else {}
    folder = store.folder if store is not None else Path.cwd()
    running: dict[Future[Any], PlannedMatch] = {}
    lost: Counter[str] = Counter()
    with StopSignals() as stop:
        ended = Completions(stop)
        while True:
            begun = {one.identity for one in running.values()}
            due = plan.due(outcomes)
            if progress is not None:
                failed = sum(isinstance(one, Failed) for one in outcomes.values())
                progress.planned(len(outcomes), len(due), failed)
            for planned in due:
                if planned.identity not in begun:
                    future = _submitted(planned, executor, folder if is_remote else None)
                    running[future] = planned
                    ended.add(future)
            if not running:
                return outcomes
            future = ended.next()
            planned = running.pop(future)
            outcome, files = _delivered(future, planned)
            if isinstance(outcome, Failed) and outcome.kind is FailureKind.WORKER:
                lost[planned.identity] += 1
                if lost[planned.identity] < _ATTEMPTS:
                    continue  # it is due still
            _write(files, folder)
            if store is not None:
                outcome = outcome if is_remote else relative_to(outcome, folder)
                store.add(outcome)
            outcomes[planned.identity] = outcome
            sentence = sentence_of(planned, outcome)
            if isinstance(outcome, Played) and outcome.missed:
                sentence += f"; {disturbance(outcome.missed)}"
            if progress is not None:
                progress.ended(sentence, failed=isinstance(outcome, Failed))


def _submitted(planned: PlannedMatch, executor: Executor, folder: Path | None) -> "Future[Any]":
    """Submit a match; `folder` is that of the run, given for workers that do not see it."""
    if folder is None:
        return executor.submit(play, planned)
    home = planned.brain_folder.absolute() if planned.brain_folder is not None else None
    return executor.submit(play_in_fresh_process, replace(planned, brain_folder=home), folder)


def _delivered(future: "Future[Any]", planned: PlannedMatch) -> tuple[Outcome, Mapping[str, bytes]]:
    """The outcome, and files to be written; a match whose process or machine is lost has failed."""
    try:
        delivered = future.result()
    except DiedProcessError as error:
        return outcome_of_death(planned, error), {}
    except TouchlineError:
        raise
    except Exception as error:  # of any library that runs workers: Dask's KilledWorker, a broken pool, an import
        reason = f"its worker failed: {type(error).__name__}: {' '.join(str(error).split())}".rstrip(": ")
        return Failed(planned.identity, FailureKind.WORKER, reason), {}
    return delivered if isinstance(delivered, tuple) else (delivered, {})


def _write(files: Mapping[str, bytes], folder: Path) -> None:
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
