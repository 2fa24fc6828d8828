"""Runs the checks of a brain in a fresh process: a hang or a crash of its code costs one check, and one line."""

import re
from collections.abc import Iterator
from concurrent.futures import wait
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec

from robot_agent.loading.user_code import is_users, shown_path
from robot_agent.process.timing import HANG_S
from touchline.matches.engine.fresh_process import DiedProcessError, FreshProcesses
from touchline.matches.engine.hang_watch import HangWatch
from touchline.team.check.checks import CHECKS, CheckResult, run_checks
from touchline.team.check.examination import Examination
from touchline.team.check.subject import Subject
from touchline.timing import POLL_S

_FRAME = re.compile(r'^  File "(.+)", line (\d+) in ', re.MULTILINE)
"""A line of a stack that faulthandler has written, the innermost first."""


def run_fresh(subject: Subject, seconds: float, hang_s: float = HANG_S) -> Iterator[CheckResult]:
    """Run all checks on a brain; results come as soon as they are known.

    Args:
        hang_s: wall time in s for one decision.

    Raises:
        TouchlineError: the match is invalid.
    """
    count = 0
    processes = FreshProcesses(1)
    try:
        with TemporaryDirectory(prefix="touchline-") as folder:
            written = Path(folder) / "results"
            written.touch()
            future = processes.submit(_run, subject, seconds, hang_s, written)
            with written.open() as lines:
                is_over = False
                while not is_over:
                    is_over = not wait([future], POLL_S).not_done
                    for line in lines:
                        count += 1
                        yield msgspec.json.decode(line, type=CheckResult)
            try:
                future.result()
            except DiedProcessError as error:
                yield CheckResult(CHECKS[count].name, kept=False, sentence=died_sentence(error))
                yield from (CheckResult(check.name, kept=None) for check in CHECKS[count + 1 :])
    finally:
        processes.shutdown(cancel_futures=True)


def _run(subject: Subject, seconds: float, hang_s: float, written: Path, note: Path) -> None:
    """What the process does: a line for each result."""
    building = subject.config.patience.attendance
    with closing(HangWatch(note, hang_s, building)) as watch, written.open("wb", buffering=0) as lines:
        for result in run_checks(Examination(replace(subject, watch=watch), seconds)):
            lines.write(msgspec.json.encode(result) + b"\n")


def died_sentence(error: DiedProcessError) -> str:
    """What ended the process, and in which line of the brain."""
    what = error.note.acting or "the check"
    if not error.note.stack:
        return f"{what}: {error}"
    frames = _FRAME.findall(error.note.stack)
    file, line = next((frame for frame in frames if is_users(frame[0])), frames[0])
    return f"{what} has not returned after {error.note.limit_s:g} s ({shown_path(file)}, line {line})"
