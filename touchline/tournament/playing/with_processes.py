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
from schemas.config.match_config import MatchConfig
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.health import Health, RobotHealth
from schemas.process.clock import WallClock
from schemas.side import Side
from schemas.topics import HEALTH
from sim_host.server.account_limits import CUT_OFF, OVER_RATE
from touchline.launch.check_brains import check_teams
from touchline.launch.confinement import team_confinements
from touchline.launch.match_run import MatchRun
from touchline.launch.processes import MatchPlan
from touchline.launch.run_folder import RUNS, prepare_credentials, prepare_run
from touchline.launch.team_error import TeamLeftError
from touchline.tournament.playing.in_process import Poll, Report, recorded_outcome
from touchline.tournament.playing.outcome import FailureKind, Outcome
from touchline.tournament.playing.planned_match import PlannedMatch

_SIGN_S = 0.5
"""Wall time between two signs of life."""
_SILENT_TICKS = 50
"""Sights in a row that no robot of a side has answered after which the side counts as hung."""
_BREACHES = (OVER_RATE, CUT_OFF)
"""Reasons for dropped messages of which one is enough: more than 250 useless messages in a quarter of a second."""
_BEFORE = "before it began"
"""Part of the reason of a match that a side left before its first state."""
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
    except TeamLeftError as error:
        kind = FailureKind.DID_NOT_START if _BEFORE in str(error) else FailureKind.CRASHED
        return _kept(planned, notes, plan.folder, Outcome.failed(kind, error.side, str(error)))
    except (TouchlineError, MatchFailedError) as error:
        return _kept(planned, notes, plan.folder, Outcome.failed(FailureKind.WORKER, None, str(error)))
    recording, config = open_recording(planned.recording), planned.config
    health = last_health(recording)
    for kind, reason_of in ((FailureKind.BROKE_ACCESS_RULES, breach_of), (FailureKind.HUNG, silence_of)):
        for side in Side:
            reason = reason_of(health, config, side)
            if reason is not None:
                return _kept(planned, notes, plan.folder, Outcome.failed(kind, side, reason))
    return recorded_outcome(recording)


def last_health(recording: Recording) -> Health | None:
    """The host's last report on its clients; None without one."""
    last = None
    for _, health in recording.decoded(HEALTH.key):
        last = health
    return last


def breach_of(health: Health | None, _: MatchConfig, side: Side) -> str | None:
    """How the account of a side broke the limits of the bus; None if it did not.

    Messages on keys that it has no right to are no breach: they never pass the router.
    """
    account = health.accounts.get(Account.of_team(side).value) if health is not None else None
    dropped = {reason: account.dropped.get(reason, 0) for reason in _BREACHES} if account is not None else {}
    counts = ", ".join(f"{count} messages were dropped: {reason}" for reason, count in dropped.items() if count)
    return f"account {side.value}: {counts}" if counts else None


def silence_of(health: Health | None, config: MatchConfig, side: Side) -> str | None:
    """Since when no robot of a side answers; None if one does."""
    robots = [health.robots.get(name, RobotHealth()) for name in config.robots(side)] if health is not None else []
    missed = min((one.missed_in_a_row for one in robots), default=0)
    if missed < _SILENT_TICKS:
        return None
    return f"none of its robots has answered the last {missed} sights"


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
