"""Plays a match with each robot in a process: for rivals, and for programs in any language."""

import shutil
import threading
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Self

from recordings.reading.recording import Recording, open_recording
from schemas.access.accounts import Account
from schemas.bus.outcome_file import read_outcome
from schemas.errors import MatchFailedError, TouchlineError
from schemas.process.clock import WallClock
from schemas.side import Side
from schemas.topics import HEALTH
from touchline.launch.check_brains import check_teams
from touchline.launch.confinement import team_confinements
from touchline.launch.match_run import EmptySideError, MatchRun
from touchline.launch.processes import MatchPlan
from touchline.launch.run_folder import RUNS, prepare_credentials, prepare_run
from touchline.tournament.playing.in_process import Poll, Report, recorded_outcome
from touchline.tournament.playing.outcome import FailureKind, Outcome
from touchline.tournament.playing.planned_match import PlannedMatch

_SIGN_S = 0.5
"""Wall time between two signs of life."""
_NOTES = "launch.log"


class _Notes:
    """A screen that keeps what is shown: evidence, if the match fails."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def status(self, line: str) -> None:
        """Show nothing."""

    def event(self, line: str, *, notable: bool) -> None:
        """Keep a line."""
        if notable:
            self.lines.append(line)

    def warn(self, line: str) -> None:
        """Keep a line."""
        self.lines.append(line)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        return None


def play_with_processes(planned: PlannedMatch, report: Report, poll: Poll) -> None:
    """Play a match and report its outcome; `poll` is called from time to time."""
    over = threading.Event()
    signs = threading.Thread(target=_give_signs, args=(over, poll), daemon=True)
    signs.start()
    try:
        outcome = _play(planned)
    finally:
        over.set()
        signs.join()
    report(outcome)


def _give_signs(over: threading.Event, poll: Poll) -> None:
    while not over.wait(_SIGN_S):
        poll()


def _play(planned: PlannedMatch) -> Outcome:
    config, notes = planned.config, _Notes()
    planned.recording.parent.mkdir(parents=True, exist_ok=True)
    planned.recording.unlink(missing_ok=True)  # of an attempt that was cut short
    confinements = team_confinements(config, planned.code_folder, RUNS)
    try:
        check_teams(config, planned.code_folder, notes.warn, confinements)
    except TouchlineError as error:
        culprit = next((side for side in Side if str(error).startswith(f"teams.{side.value}.")), None)
        return _kept(planned, notes, None, Outcome.failed(_kind(culprit), culprit, str(error)))
    plan = prepare_run(config, None, planned.recording, WallClock())
    try:
        plan = replace(prepare_credentials(plan, tls=False), confinements=confinements)
        return _launched(planned, replace(plan, brain_folder=planned.code_folder), notes)
    finally:
        shutil.rmtree(plan.folder, ignore_errors=True)
        with suppress(OSError):  # of other matches
            plan.folder.parent.rmdir()


def _launched(planned: PlannedMatch, plan: MatchPlan, notes: _Notes) -> Outcome:
    try:
        MatchRun(plan, notes, WallClock(), lambda _: {}, lambda one: read_outcome(one.outcome)).play()
    except EmptySideError as error:
        kind = FailureKind.CRASHED if error.began else FailureKind.DID_NOT_START
        return _kept(planned, notes, plan.folder, Outcome.failed(kind, error.side, str(error)))
    except (TouchlineError, MatchFailedError) as error:
        return _kept(planned, notes, plan.folder, Outcome.failed(FailureKind.WORKER, None, str(error)))
    recording = open_recording(planned.recording)
    for side in Side:
        breach = breach_of(recording, side)
        if breach is not None:
            notes.warn(breach)
            return _kept(planned, notes, plan.folder, Outcome.failed(FailureKind.BROKE_ACCESS_RULES, side, breach))
    return recorded_outcome(recording)


def breach_of(recording: Recording, side: Side) -> str | None:
    """How the account of a side broke the access rules of the bus, by the host's last report; None if it did not."""
    last = None
    for _, health in recording.decoded(HEALTH.key):
        last = health
    account = last.accounts.get(Account.of_team(side).value) if last is not None else None
    if account is None or not account.cut_off:
        return None
    dropped = ", ".join(f"{count} {reason}" for reason, count in account.dropped.items())
    return f"account {side.value} was cut off: it went on above its limit of messages ({dropped} were dropped)"


def _kind(culprit: Side | None) -> FailureKind:
    return FailureKind.DID_NOT_START if culprit is not None else FailureKind.WORKER


def _kept(planned: PlannedMatch, notes: _Notes, run: Path | None, outcome: Outcome) -> Outcome:
    """The outcome, with the logs of the match as evidence in the folder of the cup."""
    planned.evidence.mkdir(parents=True, exist_ok=True)
    for log in run.glob("*.log") if run is not None else ():
        shutil.copy(log, planned.evidence / log.name)
    lines = [*notes.lines, outcome.reason or ""]
    (planned.evidence / _NOTES).write_text("\n".join(lines), "utf-8")
    return outcome
