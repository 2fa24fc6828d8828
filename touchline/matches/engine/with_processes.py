"""Plays one match with processes, on an endpoint of its own.

A process that was forked for the match launches the others itself. In any other process, which may have threads and
children of its own, a program does so and prints the outcome.
"""

import multiprocessing
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from schemas.process import leash
from schemas.process.clock import WallClock
from touchline.launch.python_process import PYTHON, module_path_environment
from touchline.matches.engine.child_processes import FORKED, Poll
from touchline.matches.engine.match_process import MatchProcessSettings, play
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, from_json
from touchline.matches.engine.planned_match import PlannedMatch

_POLL_S = 0.2
"""Wall time between two looks whether the outcome is still wanted."""
LOG = "match.log"
"""The log of a match, next to the logs of its processes."""


class _PollingClock(WallClock):
    """Polls with each wait."""

    __slots__ = ("_poll",)

    def __init__(self, poll: Poll) -> None:
        super().__init__()
        self._poll = poll

    def sleep_until(self, moment: float) -> None:
        """Poll, then sleep until `now()` reaches `moment`."""
        self._poll()
        super().sleep_until(moment)


def play_with_processes(planned: PlannedMatch, poll: Poll = lambda: None) -> Outcome:
    """Play a match to its end; `poll` is called while it lasts. All its processes end with this one."""
    with ExitStack() as stack:
        folder = planned.logs or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="touchline-")))
        settings = MatchProcessSettings(
            config=planned.config,
            identity=planned.identity,
            folder=folder.resolve(),
            recording=planned.recording.resolve() if planned.recording is not None else None,
            brain_folder=planned.brain_folder.resolve() if planned.brain_folder is not None else None,
        )
        if _is_for_one_match():
            stack.enter_context(_log_into(folder / LOG))
            return play(settings, _PollingClock(poll))
        return _play_by_program(settings, folder, poll)


def _is_for_one_match() -> bool:
    """Whether this is a process of `ChildProcesses`: signals arrive in this thread, and no child is another's."""
    is_main = threading.current_thread() is threading.main_thread()
    return is_main and multiprocessing.current_process().name.startswith(FORKED)


@contextmanager
def _log_into(path: Path) -> Iterator[None]:
    """Have what this process writes on stderr in a file."""
    sys.stderr.flush()
    before = os.dup(2)
    with path.open("ab") as log:
        os.dup2(log.fileno(), 2)
    try:
        yield
    finally:
        sys.stderr.flush()
        os.dup2(before, 2)
        os.close(before)


def _play_by_program(settings: MatchProcessSettings, folder: Path, poll: Poll) -> Outcome:
    with (folder / LOG).open("ab") as log:
        program = subprocess.Popen(
            [
                *(sys.executable, "-I", "-S", leash.__file__, str(os.getpid()), "{}"),
                *(*PYTHON, "-m", "touchline.matches.engine.match_process", "--settings", "-"),
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
        return Failed(settings.identity, FailureKind.WORKER, reason, None, str(folder))
    return from_json(out)
