"""Plays one planned match, in whichever way it is to be played."""

import shutil

from touchline.matches.engine.child_processes import Poll
from touchline.matches.engine.code_digest import code_digest
from touchline.matches.engine.in_process import play_in_process
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome
from touchline.matches.engine.planned_match import PlannedMatch, Way
from touchline.matches.engine.with_processes import play_with_processes

_WAYS = {Way.IN_PROCESS: play_in_process, Way.PROCESSES: play_with_processes}


def play(planned: PlannedMatch, poll: Poll = lambda: None) -> Outcome:
    """Play a match; `poll` is called while it lasts. A team whose files differ from the plan's is not played.

    What an earlier attempt has left of the recording and the logs is removed.
    """
    for side, digest in planned.code.items():
        if code_digest(planned.config, side, planned.brain_folder) != digest:
            team = planned.config.team(side).name or side.value
            reason = f"the files of {team} are not those of the plan; restore them, or make a new plan"
            return Failed(planned.identity, FailureKind.WORKER, reason)
    if planned.recording is not None:
        planned.recording.parent.mkdir(parents=True, exist_ok=True)
        planned.recording.unlink(missing_ok=True)
    if planned.logs is not None:
        shutil.rmtree(planned.logs, ignore_errors=True)
        planned.logs.mkdir(parents=True, exist_ok=True)
    try:
        return _WAYS[planned.way](planned, poll)
    finally:
        if planned.logs is not None and not any(planned.logs.iterdir()):
            planned.logs.rmdir()
