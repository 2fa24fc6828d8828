"""Plays the matches of a series, and yields the row of each as it ends."""

from collections.abc import Callable
from pathlib import Path

from touchline.matches.engine.child_processes import ChildProcesses
from touchline.matches.engine.outcome import Outcome
from touchline.matches.engine.plan import ListPlan
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.run import run_plan
from touchline.matches.engine.store import MemoryStore
from touchline.matches.series.match_row import Row, row_of
from touchline.matches.series.plan import SeriesPlan


def play_series(plan: SeriesPlan, jobs: int, report: Callable[[Row], None]) -> None:
    """Play all matches, up to `jobs` at a time; `report` is called with each row. An exception ends the processes."""
    matches = plan.by_identity

    class Rows:
        """Passes on each outcome as a row."""

        def planned(self, done: int, due: int) -> None:
            """Nothing to be shown: the number of matches is known."""

        def ended(self, planned: PlannedMatch, outcome: Outcome) -> None:
            """Pass on a row."""
            report(row_of(matches[planned.identity], outcome))

    executor = ChildProcesses(jobs)
    try:
        run_plan(ListPlan(tuple(one.planned for one in plan.matches)), executor, MemoryStore(Path.cwd()), Rows())
    finally:
        executor.shutdown(cancel_futures=True)
