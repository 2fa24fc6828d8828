"""What executors call: plays a match on this machine; for other machines, brings its files back."""

import multiprocessing
import tempfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from schemas.errors import TouchlineError
from touchline.matches.engine.fresh_process import DiedProcessError, FreshProcesses
from touchline.matches.engine.in_process import outcome_of_death
from touchline.matches.engine.outcome import Outcome, relative_to
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.play import play


def play_in_fresh_process(planned: PlannedMatch, folder: Path) -> tuple[Outcome, Mapping[str, bytes]]:
    """Play a match whose files belong into `folder`, the run's on the machine that asks.

    Returns the outcome with paths in that folder, and path in it → content of all files of the match.

    Raises:
        TouchlineError: this process may not start others.
    """
    if multiprocessing.current_process().daemon:
        raise TouchlineError(
            "the Dask worker may not start processes; start it with DASK_DISTRIBUTED__WORKER__DAEMON=False in its "
            "environment, see docs/many_matches.md"
        )
    with tempfile.TemporaryDirectory(prefix="touchline-") as temporary:
        here = Path(temporary)
        moved = replace(
            planned, recording=_moved(planned.recording, folder, here), logs=_moved(planned.logs, folder, here)
        )
        with FreshProcesses(1) as process:
            try:
                outcome: Outcome = process.submit(play, moved).result()
            except DiedProcessError as error:
                outcome = outcome_of_death(moved, error)
        outcome = relative_to(outcome, here)
        files = {path.relative_to(here).as_posix(): path.read_bytes() for path in here.rglob("*") if path.is_file()}
    return outcome, files


def _moved(path: Path | None, folder: Path, to: Path) -> Path | None:
    return to / path.relative_to(folder) if path is not None else None
