"""Places in the code of a brain, for messages: the file and line of a definition, or of what an exception came from."""

import inspect
import io
import re
import sys
import traceback
from collections.abc import Callable
from contextlib import redirect_stderr
from pathlib import Path
from types import TracebackType
from typing import Any

OWN_PACKAGES = ("schemas", "runtime", "sim_host", "robot_agent", "coach_gateway", "recordings", "touchline")
"""The packages of this library."""
_ROOT = Path(__file__).resolve().parents[2]
_TEAMS = _ROOT / "robot_agent" / "teams"
"""Its folders are the teams that ship; its files are what all teams have in common."""
_NOT_USERS = [*(_ROOT / name for name in OWN_PACKAGES), Path(inspect.__file__).resolve().parent]
_SUGGESTION = re.compile(r"\. Did you mean: '\w+'\?$")
_INSTALLED = {"site-packages", "dist-packages"}


class ReturnedError(TypeError):
    """A function of a brain returned something that it may not return."""

    def __init__(self, name: str, what: str, function: Callable[..., Any], remedy: str) -> None:
        """`what` is what it returned, in words; the text has its file and line, too."""
        super().__init__(f"{name} returned {what}{definition_of(function)}; {remedy}")


def is_users(file: str) -> bool:
    """Whether code of this file belongs to a brain: not to this library, to Python, or to an installed package."""
    path = Path(file).resolve()
    if path.is_relative_to(_TEAMS) and path.parent != _TEAMS:
        return True
    is_other = any(path.is_relative_to(folder) for folder in _NOT_USERS) or not _INSTALLED.isdisjoint(path.parts)
    return not file.startswith("<") and not is_other


def sentence_of(error: BaseException) -> str:
    """Type and message of an exception in one line, with the name that Python suggests for a misspelt one."""
    printed = io.StringIO()
    with redirect_stderr(printed):  # Python 3.11 suggests only where it prints an exception itself
        sys.__excepthook__(type(error), error, error.__traceback__)
    suggestion = _SUGGESTION.search(printed.getvalue().rstrip())
    return f"{type(error).__name__}: {' '.join(str(error).split())}{suggestion[0] if suggestion else ''}"


def place_of(error: BaseException) -> str:
    """Where the brain's own code raised, or called what raised: ` (my_team.py, line 17)`.

    Empty for what was returned, whose text has the place.
    """
    if isinstance(error, ReturnedError):
        return ""
    frames = list(traceback.extract_tb(error.__traceback__))
    own = [frame for frame in frames if is_users(frame.filename)] or frames
    return f" ({shown_path(own[-1].filename)}, line {own[-1].lineno})" if own else ""


def users_traceback(error: BaseException) -> TracebackType | None:
    """The traceback of an exception from the first frame of a brain's code on; the whole one if there is none."""
    below = error.__traceback__
    while below is not None and not is_users(below.tb_frame.f_code.co_filename):
        below = below.tb_next
    return below or error.__traceback__


def definition_of(what: Callable[..., Any]) -> str:
    """Where a function or a class is defined: ` (my_team.py, line 12)`; empty if its source is unknown."""
    try:
        file = inspect.getsourcefile(what)
        line = inspect.getsourcelines(what)[1]
    except (OSError, TypeError):
        return ""
    return f" ({shown_path(file)}, line {line})" if file is not None else ""


def shown_path(file: str) -> str:
    """The path of a file, relative to the current directory or else to the folder that it was imported from."""
    path = Path(file).resolve()
    folders = (Path.cwd(), *(Path(entry).resolve() for entry in reversed(sys.path)))
    return next((str(path.relative_to(folder)) for folder in folders if path.is_relative_to(folder)), str(path))
