"""Where the code of a team lies: what its robots have to read, and what the other team should not."""

import os
import shutil
import sys
import sysconfig
from pathlib import Path
from typing import NamedTuple

from robot_agent.loading.brain_folders import BrainFolders
from robot_agent.loading.user_code import OWN_PACKAGES
from robot_agent.process.stdio.command_line import command_line
from schemas.config.match_config import MatchConfig
from schemas.config.shipped_teams import policy_file
from schemas.side import Side

_INSTALLATION = Path(__file__).resolve().parents[3]
"""The folder that this library is imported from."""


class TeamCode(NamedTuple):
    """The files of one team."""

    folder: Path | None
    """Where its modules, policy or program lie; None for a brain of this library or an installed one."""
    own: tuple[Path, ...]
    """The file, or the package, in that folder that is the team's own; the file of a policy is its code."""


def team_code(config: MatchConfig, side: Side, beside_match: Path | None) -> TeamCode:
    """The code of a side; a program with arguments is taken for the files that its command line names."""
    team = config.team(side)
    if program := team_program(config, side, beside_match):
        files = [path for path in map(_file_of, program[:1]) if path is not None]
        files += [Path(word).absolute() for word in program[1:] if os.access(word, os.F_OK)]
        own = tuple(file for file in files if not any(file.is_relative_to(one) for one in system_folders()))
        return TeamCode(own[-1].parent if own else None, own)
    brains = [team.brain or ""]
    if policy_file(brains[0]):
        brains.append(str(team.parameters.get("corrects", "")))  # comes last: its folder has what it imports
    folders = BrainFolders(beside_match)
    own = tuple(found for found in (_file_of_brain(brain, folders) for brain in brains) if found is not None)
    return TeamCode(own[-1].parent if own else None, own)


def _file_of_brain(brain: str, folders: BrainFolders) -> Path | None:
    """The package, or the file, of a brain, or of its policy; None for one of this library or an installed one."""
    if file := policy_file(brain):
        return folders.find(file)
    module = brain.partition(":")[0].partition(".")[0]
    return folders.find(module, f"{module}.py") if ":" in brain and module not in OWN_PACKAGES else None


def team_program(config: MatchConfig, side: Side, beside_match: Path | None) -> tuple[str, ...]:
    """The command line of a side's own program, for any working folder; empty for a brain.

    The files of a `command` are looked for in the current directory, of `stdio` in the match file's folder, too.
    """
    team = config.team(side)
    return command_line(team.program, beside_match if team.command is None else None) if team.program else ()


def interpreter_folders(config: MatchConfig, side: Side) -> list[Path]:
    """The virtual environment of a side's program, with the folder of its Python; none for other programs."""
    program = _file_of((config.team(side).program or [""])[0])
    if program is None or not (program.parents[1] / "pyvenv.cfg").exists():
        return []
    return [program.parents[1], program.resolve().parents[1]]


def are_rivals(one: TeamCode, other: TeamCode) -> bool:
    """Whether both teams have code of their own that comes from different folders: probably other people's."""
    return bool(one.own and other.own) and _home(one) != _home(other)


def share_a_folder(one: TeamCode, other: TeamCode) -> bool:
    """Whether the modules of two different teams lie in one folder."""
    in_packages = all(path.is_dir() for path in (*one.own, *other.own))
    return bool(one.own and other.own) and one.folder == other.folder and one.own != other.own and not in_packages


def system_folders() -> list[Path]:
    """Folders of programs and libraries, Python's and this library's among them; those that exist."""
    named = ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/etc", "/opt", "/nix", "/snap")
    python = (sys.prefix, sys.base_prefix, *(sysconfig.get_path(name) for name in ("purelib", "platlib", "stdlib")))
    packages = [_INSTALLATION / package for package in OWN_PACKAGES]
    return [path for path in map(Path, dict.fromkeys((*named, *python, *map(str, packages)))) if path.exists()]


def _home(code: TeamCode) -> Path | None:
    """The folder of a team: its package, or the folder of its file."""
    last = code.own[-1]
    return last if last.is_dir() else code.folder


def _file_of(program: str) -> Path | None:
    found = shutil.which(program)
    return Path(found).absolute() if found is not None else None
