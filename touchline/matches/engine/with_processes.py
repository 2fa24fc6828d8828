"""Plays one match with processes, on an endpoint of its own, in a process that plays nothing else."""

import os
import secrets
import shutil
import signal
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path

from recordings.container.key_selection import KeySelection
from recordings.container.parts import remove_parts
from recordings.editing.filtering import filter_recording
from recordings.reading.recording import open_recording
from runtime.bus.endpoint import FREE_ENDPOINT
from runtime.process.clock import WallClock
from schemas.config.match_parts import RecordingConfig
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.health import Health
from schemas.topics import HEALTH
from touchline.launch.check_brains import check_teams
from touchline.launch.confinement.robot_confinement import team_confinements
from touchline.launch.match_run import InterruptedMatchError, MatchRun
from touchline.launch.processes.programs import CREDENTIALS, MatchPlan, check_robot_names
from touchline.launch.run_folder import RECORDING, prepare_credentials
from touchline.launch.team_error import TeamError, TeamLeftError
from touchline.launch.terminal.agent_faults import missed_sights
from touchline.launch.terminal.screen import Screen
from touchline.matches.engine.inputs_only import KEYS, has_inputs_only
from touchline.matches.engine.measurement import measured
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, Played
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.team_faults import fault_of

LOG = "match.log"
"""The log of a match, next to the logs of its processes."""


def play_with_processes(planned: PlannedMatch) -> Outcome:
    """Play a match to its end. All its processes end with this one."""
    with ExitStack() as stack:
        folder = planned.logs or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="touchline-")))
        stack.enter_context(_log_into(folder / LOG))
        outcome = _outcome(planned, folder.resolve())
        if isinstance(outcome, Failed):
            sys.stderr.write(f"{outcome.reason}\n")
        return outcome


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


def _outcome(planned: PlannedMatch, folder: Path) -> Outcome:
    identity, logs = planned.identity, str(folder)
    wanted = planned.recording.resolve() if planned.recording is not None else None
    whole = wanted if wanted and not has_inputs_only(planned.config) else folder / RECORDING
    plan = _plan(planned, folder, whole)
    config, clock = plan.config, WallClock()
    try:
        check_robot_names(config)
        confinements = team_confinements(config, plan.brain_folder, folder.parent)
        plan = prepare_credentials(replace(plan, confinements=confinements), tls=False)
        check = partial(check_teams, config, plan.brain_folder, confinements=confinements)
        result = MatchRun(plan, Screen(sys.stderr, clock), clock, check).play()
    except TeamError as error:
        return Failed(identity, FailureKind.DID_NOT_START, str(error), (error.side,), logs)
    except TeamLeftError as error:
        kind = FailureKind.CRASHED if error.has_begun else FailureKind.DID_NOT_START
        return Failed(identity, kind, str(error), (error.side,), logs)
    except (TouchlineError, MatchFailedError) as error:
        return Failed(identity, FailureKind.WORKER, str(error), (), logs)
    except InterruptedMatchError as error:
        reason = f"it was interrupted by {signal.Signals(error.number).name}"
        return Failed(identity, FailureKind.WORKER, reason, (), logs)
    finally:
        _keep_logs_alone(folder)
    if result.recording.fault:
        return Failed(identity, FailureKind.WORKER, result.recording.fault, (), logs)
    health: Health | None = open_recording(whole).last(HEALTH.key)
    found = fault_of(health, config)
    if found is not None:
        kind, culprits, reason = found
        return Failed(identity, kind, reason, culprits, logs)
    return _kept(replace(measured(whole, identity), missed=missed_sights(health)), whole, wanted)


def _plan(planned: PlannedMatch, folder: Path, whole: Path) -> MatchPlan:
    """The processes of the match; its recorder is waited for."""
    config = planned.config
    record = RecordingConfig(wait=True) if has_inputs_only(config) else config.record.model_copy(update={"wait": True})
    return MatchPlan(
        config.model_copy(update={"record": record}),
        FREE_ENDPOINT,
        folder,
        whole,
        brain_folder=planned.brain_folder.resolve() if planned.brain_folder is not None else None,
        launch_token=secrets.token_hex(16),
    )


def _keep_logs_alone(folder: Path) -> None:
    """Remove credentials and settings from the folder of the logs: that of a cup or a study is published."""
    shutil.rmtree(folder / CREDENTIALS, ignore_errors=True)
    for path in folder.glob("*.json"):
        path.unlink()


def _kept(played: Played, whole: Path, wanted: Path | None) -> Played:
    """The outcome, with the recording that is to be kept in place of the whole one."""
    if wanted == whole:
        return played
    if wanted is not None:
        filter_recording(open_recording(whole), wanted, KeySelection(KEYS))
    remove_parts(whole)
    return replace(played, recording=str(wanted) if wanted is not None else None)
