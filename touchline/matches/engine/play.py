"""Plays one planned match, in whichever way it is to be played."""

import shutil
from contextlib import closing
from pathlib import Path

from recordings.container.parts import remove_parts
from touchline.matches.engine.code_digest import code_digest
from touchline.matches.engine.hang_watch import HangWatch
from touchline.matches.engine.in_process import play_in_process
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome
from touchline.matches.engine.planned_match import PlannedMatch, Way
from touchline.matches.engine.with_processes import play_with_processes


def play(planned: PlannedMatch, note: Path | None = None) -> Outcome:
    """Play a match. Files of a team that are not those of the plan are not played.

    What an earlier attempt has left of the recording and the logs is removed. `note` is the folder in which a process
    that plays nothing else notes who acts: it ends where a brain does not answer.
    """
    for side, digest in planned.code.items():
        if code_digest(planned.config, side, planned.brain_folder) != digest:
            team = planned.config.team(side).name or side.value
            reason = f"the files of {team} are not those of the plan; restore them, or make a new plan"
            return Failed(planned.identity, FailureKind.WORKER, reason)
    if planned.recording is not None:
        planned.recording.parent.mkdir(parents=True, exist_ok=True)
        remove_parts(planned.recording)
    if planned.logs is not None:
        shutil.rmtree(planned.logs, ignore_errors=True)
        planned.logs.mkdir(parents=True, exist_ok=True)
    try:
        if planned.way is Way.PROCESSES:
            return play_with_processes(planned)
        with closing(HangWatch(note, planned.hang_s, planned.config.patience.attendance)) as watch:
            return play_in_process(planned, watch)
    finally:
        if planned.logs is not None and not any(planned.logs.iterdir()):
            planned.logs.rmdir()
