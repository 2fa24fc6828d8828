"""The folder of a match's files under `runs/`, named after match, time and seed."""

import secrets
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

from runtime.bus.endpoint import is_loopback
from runtime.process.clock import Clock
from schemas.config.match_config import MatchConfig
from schemas.errors import os_errors
from touchline.launch.own_address import names_for_others
from touchline.launch.processes.programs import CREDENTIALS, MatchPlan

RUNS = Path("runs")
RECORDING = "match.mcap"


def prepare_run(
    config: MatchConfig, listen: str | None, recording: Path | None, clock: Clock, *, recorded: bool = True
) -> MatchPlan:
    """Make the folder of a run.

    `recording` is the file of the recording, by default in the folder. With `recorded` false there is no recording.

    If that file cannot be written, the recording goes into the folder and the plan has a warning: a match that many
    machines wait for is played all the same.

    Raises:
        TouchlineError: the folder cannot be made or written.
    """
    stem = f"{config.name}-{_moment(clock)}-seed{config.seed}"
    with os_errors(None, f"a match writes its logs under ./{RUNS}"):
        folder = _new_folder(stem)
        out = (recording or folder / RECORDING) if recorded else None
        refusal = _why_not_writable(out) if out is not None else ""
        if refusal:
            refusal = f"--record {out}: {refusal}. The match is played, its recording goes to {folder / RECORDING}"
            out = folder / RECORDING
        return MatchPlan(config, listen, folder, out, refusal, launch_token=secrets.token_hex(16))


def new_run_folder(name: str, clock: Clock) -> Path:
    """A new folder of this name and the present moment.

    Raises:
        TouchlineError: the folder cannot be made.
    """
    with os_errors(None, f"logs are written under ./{RUNS}"):
        return _new_folder(f"{name}-{_moment(clock)}")


def _moment(clock: Clock) -> str:
    return f"{datetime.fromtimestamp(clock.unix_ns() / 1e9, UTC):%Y%m%dT%H%M%SZ}"


def prepare_credentials(plan: MatchPlan, *, tls: bool) -> MatchPlan:
    """The plan with new credentials for this match alone, in its folder.

    Raises:
        TouchlineError: the package for certificates is missing, or the files cannot be written.
    """
    from runtime.access.certificates import make_certificate
    from runtime.access.credentials import new_credentials, write_credentials

    folder = plan.folder / CREDENTIALS
    names = () if plan.listen is None or is_loopback(plan.listen) else names_for_others(plan.listen)
    with os_errors(None, "a match writes its credentials there"):
        write_credentials(folder, new_credentials(plan.config.name, make_certificate(names) if tls else None))
    return with_credentials(plan, folder)


def with_credentials(plan: MatchPlan, folder: Path) -> MatchPlan:
    """The plan with the credentials in a folder: an agent that has its team's needs no secret of the launch."""
    return replace(plan, credentials=folder, launch_token=None)


def _why_not_writable(out: Path) -> str:
    """The reason why the file cannot be written, with the remedy; empty if it can."""
    from recordings.container.parts import NotWritableError, create_part

    try:
        create_part(out).close()
        out.unlink()
    except NotWritableError as error:
        return f"{error.reason}; {error.remedy}"
    except OSError as error:
        return f"{error.strerror or 'cannot be written'}; give a path that can be written"
    return ""


def _new_folder(stem: str) -> Path:
    """A new folder: two matches of the same second get different folders."""
    RUNS.mkdir(exist_ok=True)
    number = 1
    while True:
        folder = RUNS / (stem if number == 1 else f"{stem}-{number}")
        try:
            folder.mkdir()
        except FileExistsError:
            number += 1
        else:
            return folder
