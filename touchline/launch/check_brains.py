"""Checks before a match is launched: every team's program exists, and its brains can be built.

Brains are built in processes of their own, one for each team, as the robots of the match will build them.
"""

import math
import signal
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path

from robot_agent.loading.build_check import BuildCheckSettings
from robot_agent.process.stdio.command_line import check_command_line
from robot_agent.process.timing import HANG_S
from runtime.process.clock import WallClock
from runtime.process.ending import ending
from schemas.config.confinement import Isolation
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.launch.confinement.robot_confinement import Confinement, team_confinements
from touchline.launch.processes.child_process import ChildProcess
from touchline.launch.processes.process_table import ProcessKind, library_process
from touchline.launch.processes.robot_process import ROBOT_ENVIRONMENT
from touchline.launch.run_folder import RUNS
from touchline.launch.team_error import TeamError
from touchline.timing import STATUS_S

_FAULT = "touchline: brain is "
"""What the line of a faulty brain begins with."""


def check_teams(
    config: MatchConfig,
    brain_folder: Path | None = None,
    report: Callable[[str], None] = lambda _: None,
    confinements: Mapping[Side, Confinement] | None = None,
) -> None:
    """Check both teams; `report` receives a line if that takes long. Brains are confined as in the match.

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
    with ExitStack() as running:
        folder = Path(running.enter_context(tempfile.TemporaryDirectory(prefix="touchline-")))
        checks = []
        for side in built:
            checks.append(_BuildCheck(config, side, brain_folder, confinements[side], folder))
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
    if any(config.team(side).process == "team" for side in Side):
        raise TouchlineError('--reload: robots of a process = "team" share their modules; leave one of them out')
    if config.isolate is Isolation.BUBBLEWRAP:
        raise TouchlineError("--reload: robots in bubblewrap do not see changed files; leave one of them out")


class _BuildCheck:
    """The process that builds the brains of one team."""

    def __init__(
        self, config: MatchConfig, side: Side, brain_folder: Path | None, confinement: Confinement, folder: Path
    ) -> None:
        """`folder` is for its files."""
        self.side = side
        self._key = f"teams.{side.value}.brain"
        self._brain = config.team(side).brain
        self._patience = max(config.patience.attendance, HANG_S) * max(len(config.robots(side)), 1)
        beside = brain_folder.absolute() if brain_folder is not None else None
        settings = BuildCheckSettings(config=config, side=side, brain_folder=beside, launch_folder=Path.cwd())
        environment = {**ROBOT_ENVIRONMENT, "TOUCHLINE_SIDE": side.value, "TOUCHLINE_MATCH": config.name}
        module = "robot_agent.loading.build_check"
        process = library_process(side.value, ProcessKind.AGENT, settings, folder, environment, module=module)
        process = replace(process, confinement=confinement.in_folder(folder / side.value))
        self._process, self._clock = ChildProcess(process, folder), WallClock()

    def wait(self, report: Callable[[str], None]) -> None:
        """Wait until the brains are built.

        Raises:
            TouchlineError: a brain cannot be built, or takes too long.
        """
        if (status := self._process.wait(STATUS_S, self._clock)) is None:
            report(f"waiting for {self._brain} to be built")
            status = self._process.wait(self._patience, self._clock)
        if status is None:
            raise TouchlineError(
                f'{self._key} is "{self._brain}"; its robots were not built within {self._patience:g} s; '
                "shorten __init__, or raise patience.attendance in the match file"
            )
        if status != 0:
            raise TouchlineError(self._fault(status))

    def _fault(self, status: int) -> str:
        lines = self._process.last_lines() or ["no reason given"]
        for line in reversed(lines):
            if line.startswith(_FAULT):
                return f"{self._key} is {line.removeprefix(_FAULT)}"
        return f'{self._key} is "{self._brain}"; the process that builds it {ending(status)}: {lines[-1]}'

    def end(self) -> None:
        """End the process and all it started."""
        self._process.send(signal.SIGKILL)
        self._process.wait(math.inf, self._clock)
