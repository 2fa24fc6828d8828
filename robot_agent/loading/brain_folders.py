"""The folders in which brains are looked for: that of the match file, then the current one, both after all others.

No file in these folders hides a module of Python, of Touchline or of an installed package.
"""

import os
import sys
from collections.abc import Collection
from pathlib import Path

_added: list[str] = []
"""Folders that this process has appended to its module path."""


def added_folders() -> tuple[str, ...]:
    """The folders of brains that this process has appended to its module path."""
    return tuple(_added)


def remove_folders(folders: Collection[str]) -> None:
    """Take folders off the module path, for a process that has inherited it from one with other brains."""
    sys.path[:] = [entry for entry in sys.path if entry not in folders]


class BrainFolders:
    """Where the modules of brains are looked for, in this order, after everything else on Python's module path."""

    def __init__(self, beside_match: Path | None = None, here: Path | None = None) -> None:
        """`beside_match` is the folder of the match file; None without a match file.

        `here` is the directory that was current at the launch; None if it still is.
        """
        self._here = here.resolve() if here is not None else Path.cwd()
        self._beside = beside_match.resolve() if beside_match is not None else self._here

    @property
    def paths(self) -> list[Path]:
        """The folders, each once, in the order of the search."""
        return list(dict.fromkeys((self._beside, self._here)))

    def add_to_module_path(self) -> None:
        """Append the folders to Python's module path; those that are on it stay where they are."""
        new = [str(path) for path in self.paths if str(path) not in sys.path]
        if new:  # unless they are there by another name
            known = {Path(entry).resolve() for entry in sys.path}
            new = [path for path in new if Path(path) not in known]
        sys.path.extend(new)
        _added.extend(new)

    def __str__(self) -> str:
        """The folders as the end of a sentence."""
        here = f"in the current directory ({self._here})"
        return here if self._beside == self._here else f"beside the match file ({self._beside}) or {here}"

    def file_of(self, module: str) -> Path | None:
        """The file of a module in these folders, by its name with dots; None if there is none."""
        stem = Path(*module.split("."))
        return self.find(stem.with_suffix(".py"), stem / "__init__.py")

    def find(self, *names: Path | str) -> Path | None:
        """The first of these files or folders in the first folder that has one; None if there is none."""
        found = (path / name for path in self.paths for name in names)
        return next((path for path in found if os.access(path, os.F_OK)), None)  # a name may be too long for a file
