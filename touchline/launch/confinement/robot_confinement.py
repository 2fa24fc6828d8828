"""The confinement of a robot's process: environment, working folder, limits, and what isolates it from others."""

import os
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from runtime.process.leash import OwnConfinement
from schemas.config.confinement import Isolation, Limits
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.launch.confinement.bubblewrap import NOBODY, bubblewrap, check_bubblewrap
from touchline.launch.confinement.robot_environment import robot_environment
from touchline.launch.confinement.team_code import (
    are_rivals,
    interpreter_folders,
    share_a_folder,
    system_folders,
    team_code,
)

_GRACE_S = 5
"""CPU time in s from the signal SIGXCPU to SIGKILL."""
_CREDENTIALS = "credentials.json"
"""Name of the team's credentials in the working folder of an isolated robot."""


@dataclass(frozen=True, slots=True)
class Confinement:
    """How one robot's process is confined."""

    limits: Limits
    folder: Path
    """Its working folder, an absolute path."""
    tasks: int
    """Most processes and threads of the user that it runs as, in all."""
    passed: tuple[str, ...] = ()
    """Names of further variables of the launcher's environment that it gets."""
    user: int | None = None
    """Id of the user and the group that it runs as; None for the launcher's."""
    visible: tuple[Path, ...] | None = None
    """What it can read in bubblewrap; None without bubblewrap."""
    hidden: tuple[Path, ...] = ()
    """What it cannot read there."""
    credentials: Path | None = None
    """The file of the team's credentials; None in a match without."""

    @property
    def readable_credentials(self) -> Path | None:
        """The file of the credentials that the robot can read: a copy where it is isolated."""
        return self.folder / _CREDENTIALS if self.is_isolated and self.credentials is not None else self.credentials

    @property
    def is_isolated(self) -> bool:
        """Whether it has a view of the machine of its own."""
        return self.visible is not None

    def environment(self, own: Mapping[str, str]) -> dict[str, str]:
        """Its whole environment, with its own variables."""
        return robot_environment(os.environ, own, self.folder, self.passed)

    def command(self, command: Iterable[str]) -> tuple[str, ...]:
        """The command line of a program, within bubblewrap where it is used."""
        wrapper = bubblewrap(self.folder, self.visible, self.hidden) if self.visible is not None else []
        return (*wrapper, *command)

    def own(self) -> OwnConfinement:
        """What the process applies to itself."""
        limits, cpu_s = self.limits, round(self.limits.cpu_time)
        memory, file = round(limits.memory * 1e9), round(limits.file_size * 1e6)
        return {
            "limits": {
                "RLIMIT_CPU": (cpu_s, cpu_s + _GRACE_S),
                "RLIMIT_DATA": (memory, memory),
                "RLIMIT_NOFILE": (limits.open_files, limits.open_files),
                "RLIMIT_NPROC": (self.tasks, self.tasks),
                "RLIMIT_FSIZE": (file, file),
                "RLIMIT_CORE": (0, 0),
            },
            "folder": str(self.folder),
        }

    def in_folder(self, folder: Path) -> "Confinement":
        """The same with another working folder."""
        return replace(self, folder=folder.absolute())

    def make_folder(self) -> None:
        """Make the working folder, which no other user may enter, with the credentials of an isolated robot.

        Raises:
            OSError: it cannot be made.
        """
        self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if self.user is not None:
            os.chown(self.folder, self.user, self.user)
            self.folder.parent.chmod(self.folder.parent.stat().st_mode | 0o011)
        if self.is_isolated and self.credentials is not None:
            copy = self.folder / _CREDENTIALS
            copy.unlink(missing_ok=True)  # the folder is the robot's, and no link in it is to be followed
            with os.fdopen(os.open(copy, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
                if self.user is not None:
                    os.fchown(file.fileno(), self.user, self.user)
                file.write(self.credentials.read_bytes())

    def remove_empty_folder(self) -> None:
        """Remove the working folder if the robot has left nothing in it."""
        with suppress(OSError):
            if self.is_isolated:
                (self.folder / _CREDENTIALS).unlink(missing_ok=True)
            self.folder.rmdir()


def team_confinements(config: MatchConfig, beside_match: Path | None, runs: Path) -> dict[Side, Confinement]:
    """The confinement of the robots of each side that is launched here, without their folders.

    `beside_match` is the folder of the match file, `runs` the folder of all runs.

    Raises:
        TouchlineError: this machine cannot isolate them as the match file asks.
    """
    is_isolated = config.isolate is Isolation.BUBBLEWRAP
    user = NOBODY if is_isolated and os.geteuid() == 0 else None
    counted = os.geteuid() if user is None else user
    others = _tasks_of_user(counted) if counted else 0  # the kernel does not limit root
    robots = sum(len(config.robots(side)) for side in config.local_sides)
    confinements = {}
    for side in config.local_sides:
        limits = config.limits_of(side)
        tasks, passed = others + limits.processes * max(1, robots), tuple(config.team(side).pass_environment)
        confinement = Confinement(limits, Path("/"), tasks, passed, user)
        if is_isolated:
            visible, hidden = _view(config, side, beside_match, runs)
            check_bubblewrap(visible, hidden, user)
            if user is not None:
                _check_open(runs)
            confinement = replace(confinement, visible=visible, hidden=hidden)
        confinements[side] = confinement
    return confinements


def _check_open(runs: Path) -> None:
    """Check that nobody may enter the folders above this one, in which each robot has its working folder.

    Raises:
        TouchlineError: a folder is closed.
    """
    for folder in runs.absolute().parents:
        if folder.exists() and not folder.stat().st_mode & 0o001:
            raise TouchlineError(
                f"--isolate bubblewrap: robots that root launches run as nobody, who may not enter {folder}; "
                "start the match in another folder, or as another user"
            )


def _view(
    config: MatchConfig, side: Side, beside_match: Path | None, runs: Path
) -> tuple[tuple[Path, ...], tuple[Path, ...]]:
    """What the robots of a side can read in bubblewrap, and what not."""
    code, rival = team_code(config, side, beside_match), team_code(config, side.opponent, beside_match)
    paths = [Path(entry).absolute() for entry in os.environ.get("PYTHONPATH", "").split(os.pathsep) if entry]
    folders = [*system_folders(), *interpreter_folders(config, side), *paths, *filter(None, [code.folder])]
    hidden = [path for path in rival.own if not any(own.is_relative_to(path) for own in code.own)]
    return (*folders, *code.own), (*hidden, runs.absolute())


def isolation_note(config: MatchConfig, beside_match: Path | None) -> str:
    """What the teams of a match are not isolated from, in one sentence; empty where there is nothing to tell a user.

    Two teams with code of their own from different folders are probably different people's.
    """
    codes = {side: team_code(config, side, beside_match) for side in Side}
    if config.isolate is Isolation.NONE and are_rivals(*codes.values()):
        return (
            "robots run as your user: both teams can read your files and each other's, and signal your processes; "
            "--isolate bubblewrap prevents it"
        )
    if config.isolate is Isolation.BUBBLEWRAP and share_a_folder(*codes.values()):
        return (
            f"both teams' code is in {codes[Side.CYAN].folder}: each is kept from the other's module, but not from "
            "other files there; put each team into a folder of its own"
        )
    return ""


def team_isolation_note(config: MatchConfig, side: Side, beside: Path | None) -> str:
    """What the robots of one team are not isolated from, in one sentence; empty for brains of this library."""
    if config.isolate is not Isolation.NONE or not team_code(config, side, beside).own:
        return ""
    return (
        "robots run as your user: they can read your files and signal your processes; --isolate bubblewrap prevents it"
    )


def _tasks_of_user(user: int) -> int:
    """The number of processes and threads of a user, as the kernel counts them for RLIMIT_NPROC."""
    found = 0
    for task in Path("/proc").glob("[0-9]*/task/*"):
        with suppress(OSError):  # it has ended
            found += task.stat().st_uid == user
    return found
