"""Python processes of a match: no file in the current directory hides a module that they import."""

import os
import sys
from pathlib import Path

PYTHON = (sys.executable, "-P")
"""Runs Python without the current directory on its module path."""


def module_path_environment() -> dict[str, str]:
    """The change of environment after which PYTHONPATH does not name the current directory; empty without need.

    An empty entry names the current directory, too. It is kept if it is the checkout that this library runs from.
    """
    given, here = os.environ.get("PYTHONPATH", ""), Path.cwd()
    if here == Path(__file__).resolve().parents[3]:
        return {}
    kept = os.pathsep.join(entry for entry in given.split(os.pathsep) if entry and Path(entry).resolve() != here)
    return {"PYTHONPATH": kept} if kept != given else {}
