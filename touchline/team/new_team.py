"""Makes the folder of a new team from `touchline/team/template`."""

import keyword
import re
from importlib import resources, util
from pathlib import Path

from schemas.errors import TouchlineError, os_errors

TEMPLATE = "touchline.team.template"
FILES = ("team_name.py", "match.toml", "test_team_name.py", "pytest.ini", "README.md")
"""The files of a team."""


def class_name(name: str) -> str:
    """The class of a team: `my_team` → `MyTeam`."""
    return "".join(part.capitalize() for part in name.split("_"))


def make_team(name: str, parent: Path) -> Path:
    """Make the folder `name` in `parent`, and return its path.

    Raises:
        TouchlineError: the name is not one for a module, hides another module, or the folder exists or cannot be made.
    """
    folder = parent / name
    reason = _why_not(name, folder)
    if reason is not None:
        raise TouchlineError(reason)
    source = resources.files(TEMPLATE)
    with os_errors(folder, "choose another folder with --in"):
        folder.mkdir(parents=True)
        for file in FILES:
            text = (source / file).read_text(encoding="utf-8")
            (folder / _named(file, name)).write_text(_named(text, name), encoding="utf-8")
    return folder


def _named(text: str, name: str) -> str:
    return text.replace("team_name", name).replace("TeamName", class_name(name))


def _why_not(name: str, folder: Path) -> str | None:
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name) or keyword.iskeyword(name):
        return f'the name is "{name}"; write lower-case letters, digits and _, beginning with a letter, such as my_team'
    if folder.exists():
        return f"{folder} exists already; choose another name, or --in another folder"
    found = util.find_spec(name)
    if found is not None and found.origin is not None:  # a module hides folders of its name
        return f'the name is "{name}", which another module has ({found.origin}); choose another'
    return None
