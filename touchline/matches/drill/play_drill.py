"""Plays one drill and gives its verdict; and many in parallel."""

from collections.abc import Callable, Generator, Iterable
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from touchline.matches.drill.judge import Verdict
from touchline.matches.drill.occurrences import OccurrenceTracker
from touchline.matches.drill.scene_run import run_scene
from touchline.matches.engine.child_processes import DiedProcessError, run_in_processes
from touchline.matches.engine.in_process import reason_of
from touchline.play import InProcessMatch


@dataclass(frozen=True, slots=True)
class PlannedDrill:
    """One drill: its match, which starts in a scene with a `[drill]`."""

    config: MatchConfig
    brain_folder: Path | None = None

    @property
    def seed(self) -> int:
        """Seed of the start and of all random numbers."""
        return self.config.seed


@dataclass(frozen=True, slots=True)
class DrillRow:
    """How one drill ended; without a verdict it failed to be played, for the reason given."""

    seed: int
    verdict: Verdict | None
    reason: str = ""


def play_drill(planned: PlannedDrill, poll: Callable[[], None] = lambda: None) -> DrillRow:
    """Play a drill to its verdict."""
    scene = planned.config.scene
    drill = scene.drill if scene is not None else None
    try:
        match = InProcessMatch(planned.config, brain_folder=planned.brain_folder)
    except TouchlineError as error:
        return DrillRow(planned.seed, None, str(error))
    try:
        tracker = OccurrenceTracker(match.simulation.setup())
        return DrillRow(planned.seed, run_scene(match, tracker, drill, None, poll=poll))
    except (Exception, SystemExit) as error:
        return DrillRow(planned.seed, None, reason_of(match, error))
    finally:
        match.close()


def play_drills(drills: Iterable[PlannedDrill], jobs: int) -> Generator[DrillRow, None, None]:
    """Play drills in up to `jobs` processes at a time; yields each as it ends. Closing it ends the processes."""
    with closing(run_in_processes(play_drill, drills, jobs)) as results:
        for planned, result in results:
            yield DrillRow(planned.seed, None, str(result)) if isinstance(result, DiedProcessError) else result
