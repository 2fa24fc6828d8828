"""Checks before a match is launched: every team's program exists, and its brains can be built.

Brains are built in processes of their own, one for each team, as the robots of the match will build them.
"""

import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import IO

from robot_agent.build_check import BuildCheckSettings
from robot_agent.stdio.command_line import check_command_line
from schemas.config.confinement import Isolation
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.process import leash
from schemas.side import Side
from touchline.launch.bubblewrap import run_as
from touchline.launch.confinement import Confinement, team_confinements
from touchline.launch.fork_server import PATIENCE_S, ForkServer
from touchline.launch.python_process import PYTHON, module_path_environment
from touchline.launch.robot_fork import RobotProcess
from touchline.launch.robot_process import ROBOT_ENVIRONMENT
from touchline.launch.run_folder import RUNS
from touchline.launch.team_error import TeamError

NOTICE_S = 3.0
"""Wall time after which a wait for brains is reported."""
LEAST_PATIENCE_S = 10.0
"""Wall time for a brain to be built where the match file allows less."""
_FAULT = "touchline: brain is "
"""What the line of a faulty brain begins with."""


def check_teams(
    config: MatchConfig,
    brain_folder: Path | None = None,
    report: Callable[[str], None] = lambda _: None,
    confinements: Mapping[Side, Confinement] | None = None,
) -> None:
    """Check both teams; `report` receives a line if that takes long. Brains are confined as those of the match.

    Raises:
        TeamError: a program does not exist, or a brain cannot be built; the message names its key.
        TouchlineError: this machine cannot isolate the teams as the match file asks.
    """
    here = config.local_sides
    for side in here:
        team = config.team(side)
        with _blamed_on(side):
            if team.command is not None:
                check_command_line(f"teams.{side.value}.command", team.command)
            if team.stdio is not None:
                check_command_line(f"teams.{side.value}.stdio", team.stdio, brain_folder)
    confinements = confinements or team_confinements(config, brain_folder, RUNS)
    built = [side for side in here if config.team(side).program is None]
    server = ForkServer()
    if not all(confinements[side].is_isolated for side in built):
        server.prepare(ROBOT_ENVIRONMENT)
    with ExitStack() as running:
        checks = []
        for side in built:
            folder = Path(running.enter_context(tempfile.TemporaryDirectory(prefix="touchline-")))
            checks.append(_BuildCheck(config, side, brain_folder, confinements[side].in_folder(folder), server))
            running.callback(checks[-1].end)
        for check in checks:
            with _blamed_on(check.side):
                check.wait(report)


@contextmanager
def _blamed_on(side: Side) -> Iterator[None]:
    try:
        yield
    except TouchlineError as error:
        raise TeamError(side, str(error)) from None


def check_reload(config: MatchConfig) -> None:
    """Check that changed code can be loaded while this match runs.

    Raises:
        TouchlineError: no robot of this machine has a brain, or brains do not see changed files.
    """
    if all(config.team(side).program is not None or side in config.remote_sides for side in Side):
        raise TouchlineError("--reload is for brains, and no team of this match has one on this machine; leave it out")
    if config.isolate is Isolation.BUBBLEWRAP:
        raise TouchlineError("--reload: robots in bubblewrap do not see changed files; leave one of them out")


class _BuildCheck:
    """The process that builds the brains of one team."""

    def __init__(
        self, config: MatchConfig, side: Side, brain_folder: Path | None, confinement: Confinement, server: ForkServer
    ) -> None:
        """An isolated team's process is started by its command line, any other is forked."""
        self.side = side
        self._key = f"teams.{side.value}.brain"
        self._brain = config.team(side).brain
        robots = len(config.robots(side))
        self._patience = max(config.patience.attendance, LEAST_PATIENCE_S) * max(robots, 1)
        folder = brain_folder.absolute() if brain_folder is not None else None
        settings = BuildCheckSettings(config=config, side=side, brain_folder=folder, launch_folder=Path.cwd())
        named = {"TOUCHLINE_SIDE": side.value, "TOUCHLINE_MATCH": config.name}
        environment = confinement.environment({**ROBOT_ENVIRONMENT, **module_path_environment(), **named})
        confinement.make_folder()
        self._log = tempfile.NamedTemporaryFile(prefix="touchline-")  # noqa: SIM115 - closed by `end`
        forked = None
        if not confinement.is_isolated:
            forked = server.fork_build(settings, environment, confinement.own(), Path(self._log.name))
        self._process = (
            _ForkedBuild(*forked)
            if forked is not None
            else _LaunchedBuild(settings, environment, confinement, self._log)
        )

    def wait(self, report: Callable[[str], None]) -> None:
        """Wait until the brains are built.

        Raises:
            TouchlineError: a brain cannot be built, or takes too long.
        """
        status = self._process.wait(NOTICE_S)
        if status is None:
            report(f"waiting for {self._brain} to be built")
            status = self._process.wait(self._patience)
        if status is None:
            raise TouchlineError(
                f'{self._key} is "{self._brain}"; its robots were not built within {self._patience:g} s; '
                "shorten __init__, or raise patience.attendance in the match file"
            )
        if status != 0:
            raise TouchlineError(self._fault(status))

    def _fault(self, status: int) -> str:
        self._log.seek(0)
        text = self._log.read().decode("utf-8", "replace")
        lines = [line for line in text.splitlines() if line.strip()] or ["no reason given"]
        for line in reversed(lines):
            if line.startswith(_FAULT):
                return f"{self._key} is {line.removeprefix(_FAULT)}"
        how = f"ended with status {status}" if status > 0 else f"was ended by {signal.Signals(-status).name}"
        return f'{self._key} is "{self._brain}"; the process that builds it {how}: {lines[-1]}'

    def end(self) -> None:
        """End the process and all it started."""
        self._process.end()
        self._log.close()


class _ForkedBuild:
    """A process of the robots' fork server."""

    def __init__(self, process: RobotProcess, group_ready: Connection) -> None:
        self._process, self._group_ready = process, group_ready

    def wait(self, seconds: float) -> int | None:
        """Exit status, negative for a signal; None if it still runs after this time."""
        self._process.join(seconds)
        return self._process.exitcode

    def end(self) -> None:
        """End the process and its group."""
        self._group_ready.poll(PATIENCE_S)
        assert self._process.pid is not None
        _end_group(self._process.pid)
        self._process.join()


class _LaunchedBuild:
    """A program of its own, confined as the robots of its team."""

    def __init__(
        self, settings: BuildCheckSettings, environment: Mapping[str, str], confinement: Confinement, log: IO[bytes]
    ) -> None:
        launcher = (sys.executable, "-I", "-S", leash.__file__, str(os.getpid()), json.dumps(confinement.own()))
        check = confinement.command((*PYTHON, "-m", "robot_agent.build_check", "--settings", "-"))
        with tempfile.TemporaryFile() as file:
            file.write(settings.model_dump_json().encode())
            file.seek(0)
            self._popen = subprocess.Popen(
                [*launcher, *check],
                **run_as(confinement.user),
                env=environment,
                stdin=file,
                stdout=log,
                stderr=subprocess.STDOUT,
                process_group=0,
            )

    def wait(self, seconds: float) -> int | None:
        """Exit status, negative for a signal; None if it still runs after this time."""
        try:
            return self._popen.wait(seconds)
        except subprocess.TimeoutExpired:
            return None

    def end(self) -> None:
        """End the process and its group."""
        _end_group(self._popen.pid)
        self._popen.wait()


def _end_group(pid: int) -> None:
    with suppress(ProcessLookupError):
        os.killpg(pid, signal.SIGKILL)
