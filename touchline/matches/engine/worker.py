"""What executors call: plays a match on this machine; for other machines, brings its files back."""

import os
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from schemas.process.clock import WallClock
from touchline.matches.engine.child_processes import ChildProcesses, DiedProcessError, Poll
from touchline.matches.engine.in_process import outcome_of_death
from touchline.matches.engine.outcome import Failed, Outcome
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.play import play


@dataclass(frozen=True, slots=True)
class Delivery:
    """An outcome, and the files that belong to it."""

    outcome: Outcome
    files: Mapping[str, bytes] = field(default_factory=dict)
    """Path in the folder of the run → content; empty where the worker has written them there itself."""
    worker: str = ""
    """Machine and process that played it."""
    wall_s: float = 0.0
    """Wall time of the match, from its launch to its outcome, in s."""


def play_here(planned: PlannedMatch, poll: Poll = lambda: None) -> Delivery:
    """Play a match on the machine with the folder of the run; `poll` is called while it lasts."""
    clock = WallClock()
    began = clock.now()
    outcome = play(planned, poll)
    return Delivery(outcome, worker=_this_worker(), wall_s=clock.now() - began)


def play_on_worker(planned: PlannedMatch, folder: Path, keep: Path | None) -> Delivery:
    """Play a match whose files belong into `folder`, the run's on the machine that asks.

    The recording stays in the folder `keep` of this machine if that is given; everything else is brought back.
    """
    with tempfile.TemporaryDirectory(prefix="touchline-") as temporary:
        here = Path(temporary)
        recording = planned.recording
        stays = recording is not None and keep is not None
        moved = replace(
            planned,
            recording=_moved(recording, folder, keep if stays and keep is not None else here),
            logs=_moved(planned.logs, folder, here),
        )
        with ChildProcesses(1) as child:
            try:
                played: Delivery = child.submit(play_here, moved).result()
            except DiedProcessError as error:
                played = Delivery(outcome_of_death(moved, error), worker=_this_worker())
        files = {path.relative_to(here).as_posix(): path.read_bytes() for path in here.rglob("*") if path.is_file()}
        return replace(played, outcome=_with_paths(played.outcome, here, folder), files=files)


def _this_worker() -> str:
    return f"{os.uname().nodename}, process {os.getpid()}"


def _moved(path: Path | None, folder: Path, to: Path) -> Path | None:
    return to / path.relative_to(folder) if path is not None else None


def _with_paths(outcome: Outcome, here: Path, folder: Path) -> Outcome:
    """The outcome with the paths that its files will have."""
    if isinstance(outcome, Failed):
        evidence = outcome.evidence
        return replace(outcome, evidence=evidence.replace(str(here), str(folder), 1)) if evidence else outcome
    recording = outcome.recording
    return replace(outcome, recording=recording.replace(str(here), str(folder), 1)) if recording else outcome
