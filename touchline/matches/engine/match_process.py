"""The program that plays one match of a plan with processes: `python -m touchline.matches.engine.match_process`.

Its log is on stderr, the outcome on stdout.
"""

import secrets
import shutil
import signal
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

from pydantic import Field

from recordings.container.key_selection import KeySelection
from recordings.editing.filtering import filter_recording
from recordings.reading.recording import open_recording
from schemas.bus.endpoint import FREE_ENDPOINT
from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import RecordingConfig
from schemas.config.settings import Settings
from schemas.config.settings_file import run_process
from schemas.errors import MatchFailedError, TouchlineError
from schemas.process.clock import Clock, WallClock
from touchline.launch.check_brains import check_teams
from touchline.launch.confinement import team_confinements
from touchline.launch.match_files import losses_of, published_by
from touchline.launch.match_run import InterruptedMatchError, MatchRun
from touchline.launch.processes import CREDENTIALS, MatchPlan, check_robot_names
from touchline.launch.run_folder import RECORDING, prepare_credentials
from touchline.launch.team_error import TeamError, TeamLeftError
from touchline.matches.engine.inputs_only import KEYS, has_inputs_only
from touchline.matches.engine.measurement import measured
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, Played, to_json
from touchline.matches.engine.team_faults import fault_of, last_health
from touchline.watch.screen import PlainScreen


class MatchProcessSettings(Settings):
    """A match to play with processes."""

    config: MatchConfig
    """The match."""
    identity: str = Field(min_length=1)
    """Identity of the planned match."""
    folder: Path
    """The folder of logs; it exists."""
    recording: Path | None = None
    """The recording to keep."""
    brain_folder: Path | None = None
    """Where brains are looked for first."""


def play(settings: MatchProcessSettings, clock: Clock) -> Outcome:
    """Play the match; its log is on stderr."""
    outcome = _outcome(settings, clock)
    if isinstance(outcome, Failed):
        sys.stderr.write(f"{outcome.reason}\n")
    return outcome


def _outcome(settings: MatchProcessSettings, clock: Clock) -> Outcome:
    config, identity, logs = settings.config, settings.identity, str(settings.folder)
    whole = settings.recording if settings.recording and not has_inputs_only(config) else settings.folder / RECORDING
    record = RecordingConfig(wait=True) if has_inputs_only(config) else config.record.model_copy(update={"wait": True})
    config = config.model_copy(update={"record": record})
    plan = MatchPlan(
        config,
        FREE_ENDPOINT,
        settings.folder,
        whole,
        brain_folder=settings.brain_folder,
        launch_token=secrets.token_hex(16),
    )
    try:
        check_robot_names(config)
        confinements = team_confinements(config, settings.brain_folder, settings.folder.parent)
        plan = prepare_credentials(replace(plan, confinements=confinements), tls=False)
        check = partial(check_teams, config, settings.brain_folder, confinements=confinements)
        result = MatchRun(plan, PlainScreen(sys.stderr, clock), clock, losses_of, published_by, check).play()
    except TeamError as error:
        return Failed(identity, FailureKind.DID_NOT_START, str(error), error.side, logs)
    except TeamLeftError as error:
        kind = FailureKind.CRASHED if error.has_begun else FailureKind.DID_NOT_START
        return Failed(identity, kind, str(error), error.side, logs)
    except (TouchlineError, MatchFailedError) as error:
        return Failed(identity, FailureKind.WORKER, str(error), None, logs)
    except InterruptedMatchError as error:
        reason = f"it was interrupted by {signal.Signals(error.number).name}"
        return Failed(identity, FailureKind.WORKER, reason, None, logs)
    finally:
        _keep_logs_alone(settings.folder)
    if result.recording.fault:
        return Failed(identity, FailureKind.WORKER, result.recording.fault, None, logs)
    found = fault_of(last_health(open_recording(whole)), config)
    if found is not None:
        kind, culprit, reason = found
        return Failed(identity, kind, reason, culprit, logs)
    return _kept(measured(whole, identity), whole, settings.recording)


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
    whole.unlink()
    return replace(played, recording=str(wanted) if wanted is not None else None)


def run(settings: MatchProcessSettings) -> int:
    """Play the match, and print its outcome."""
    sys.stdout.buffer.write(to_json(play(settings, WallClock())))
    return 0


if __name__ == "__main__":
    raise SystemExit(run_process("touchline.matches.engine.match_process", MatchProcessSettings, run))
