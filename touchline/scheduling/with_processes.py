"""Plays one match with processes, on an endpoint of its own: a program plays it, and prints the outcome."""

import os
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path

from schemas.process import leash
from touchline.launch.python_process import PYTHON, module_path_environment
from touchline.scheduling.child_processes import Poll
from touchline.scheduling.match_process import MatchProcessSettings
from touchline.scheduling.outcome import Failed, FailureKind, Outcome, from_json
from touchline.scheduling.planned_match import PlannedMatch

_POLL_S = 0.2
"""Wall time between two looks whether the outcome is still wanted."""
LOG = "match.log"
"""The log of a match, beside those of its processes."""


def play_with_processes(planned: PlannedMatch, poll: Poll = lambda: None) -> Outcome:
    """Play a match to its end; `poll` is called while it lasts. The program ends with this process."""
    with ExitStack() as stack:
        folder = planned.logs or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="touchline-")))
        settings = MatchProcessSettings(
            config=planned.config,
            identity=planned.identity,
            folder=folder.resolve(),
            recording=planned.recording.resolve() if planned.recording is not None else None,
            brain_folder=planned.brain_folder.resolve() if planned.brain_folder is not None else None,
        )
        log = stack.enter_context((folder / LOG).open("ab"))
        program = subprocess.Popen(
            [
                *(sys.executable, "-I", "-S", leash.__file__, str(os.getpid()), "{}"),
                *(*PYTHON, "-m", "touchline.scheduling.match_process", "--settings", "-"),
            ],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=log,
            env={**os.environ, **module_path_environment()},
        )
        text: bytes | None = settings.model_dump_json().encode()
        while True:
            try:
                out, _ = program.communicate(text, timeout=_POLL_S)
                break
            except subprocess.TimeoutExpired:
                text = None
                poll()
        if program.returncode:
            reason = f"the program of the match ended with status {program.returncode}"
            return Failed(planned.identity, FailureKind.WORKER, reason, None, str(folder))
        return from_json(out)
