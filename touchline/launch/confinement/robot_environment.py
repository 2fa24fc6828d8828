"""The environment of a robot's process: a list of allowed variables and its own, nothing else of the launcher's.

Tokens and passwords in the launcher's environment do not reach the programs of a team.
"""

import os
import site
from collections.abc import Iterable, Mapping
from pathlib import Path

ALLOWED = ("PATH", "LANG", "LANGUAGE", "TZ", "USER", "LOGNAME", "TERM", "VIRTUAL_ENV", "LD_LIBRARY_PATH")
"""Variables of the launcher that a program needs to be found, to load its libraries, and to print."""
ALLOWED_BEGINNINGS = ("LC_", "PYTHON")
"""The beginnings of further ones."""
_OF_ONE_ROBOT = ("HOME", "TOUCHLINE_")
"""The beginnings of those that robots do not share."""


def robot_environment(
    launcher: Mapping[str, str], own: Mapping[str, str], folder: Path, passed: Iterable[str] = ()
) -> dict[str, str]:
    """The whole environment of a robot's process.

    Args:
        launcher: the launcher's environment.
        own: the robot's own variables.
        folder: its working folder, which is its home, too.
        passed: names of further variables of the launcher, which the match file lists.
    """
    names = {*ALLOWED, *passed}
    kept = {name: value for name, value in launcher.items() if name in names or name.startswith(ALLOWED_BEGINNINGS)}
    if site.ENABLE_USER_SITE:
        kept.setdefault("PYTHONUSERBASE", site.getuserbase())  # with another home, packages of the user are found
    environment = {**kept, **own, "HOME": str(folder)}
    if environment.get("PYTHONPATH"):
        folders = environment["PYTHONPATH"].split(os.pathsep)  # the robot has another working folder
        environment["PYTHONPATH"] = os.pathsep.join(str(Path(folder).absolute()) for folder in folders)
    return environment


def server_environment(own: Mapping[str, str]) -> dict[str, str]:
    """The environment of the fork server: each robot can read it as the one its process began with."""
    environment = robot_environment(os.environ, own, Path("/"))
    return {name: value for name, value in environment.items() if not name.startswith(_OF_ONE_ROBOT)}
