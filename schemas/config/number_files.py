"""Reads profiles and rule books from TOML: shipped ones by name, a user's own by path, merged where they extend.

A file has an optional `extends`, the name of the file whose numbers it changes, and a `version`: a whole number that is
raised with every change of a number, of the file or of one that it extends.
"""

import tomllib
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Any

from schemas.config.quantity import merge_tables, read_section
from schemas.config.toml_file import UNREADABLE, from_folder
from schemas.errors import TouchlineError, did_you_mean, os_errors

VERSION_KEY = "version"
PROFILE_KEY = "profile"
"""In a rule book: the profile whose pitch it describes."""
HEADER = (VERSION_KEY, PROFILE_KEY)
"""Keys of a file that those which extend it do not get."""
UNVERSIONED = 0
"""The version of a file without one, a user's own."""


@dataclass(frozen=True, slots=True)
class NumberFiles:
    """The files of one kind."""

    kind: str
    """The key of the match file that names one."""
    folder: str
    """Folder of the shipped files, below `schemas`."""
    shipped: tuple[str, ...]

    def tables(self, name: str, below: tuple[str, ...] = ()) -> dict[str, Any]:
        """The tables of a file, merged into those that it extends; `below` are the files that extend it.

        Raises:
            TouchlineError: there is no such file, it is not TOML, or it extends itself.
        """
        if name in below:
            raise TouchlineError(f"{name}: extends itself through {' → '.join(below)}; break the circle")
        tables = self.read(name)
        parent = tables.pop("extends", None)
        if parent is None:
            return tables
        base = self.tables(from_folder(Path(name).parent, str(parent)), (*below, name))
        inherited = {key: value for key, value in base.items() if key not in HEADER}
        return merge_tables(inherited, tables)

    def read(self, name: str) -> dict[str, Any]:
        """The content of one file: of a shipped one by name, or of one from a path that ends in `.toml`.

        Raises:
            TouchlineError: there is no such file, or it is not TOML.
        """
        try:
            return deepcopy(_parsed(self._text(name)))
        except UNREADABLE as error:
            raise TouchlineError(f"{name}: not TOML: {error}") from None

    def _text(self, name: str) -> str:
        if name in self.shipped:
            return (resources.files("schemas") / self.folder / f"{name}.toml").read_text("utf-8")
        if not name.endswith(".toml"):
            known = did_you_mean(name, self.shipped)
            raise TouchlineError(f'{self.kind} is "{name}"; give a name, or a path that ends in .toml; {known}')
        with os_errors(f'{self.kind} is "{name}"', f"give one of {', '.join(self.shipped)}"):
            return Path(name).read_text("utf-8")


@lru_cache(maxsize=32)
def _parsed(text: str) -> dict[str, Any]:
    """The content of a file; parsing takes eight times as long as a copy, and a match reads each several times."""
    return tomllib.loads(text)


def read_numbers(
    name: str,
    tables: Mapping[str, Any],
    sections: Mapping[str, type],
    header: tuple[str, ...],
    others: tuple[str, ...] = (),
) -> tuple[dict[str, Any], dict[str, str], int]:
    """The sections of a file, `section.key` → origin of each number, and the file's version.

    `header` and `others` are the keys and tables that the file may have besides its sections.

    Raises:
        TouchlineError: the tables are invalid.
    """
    origins: dict[str, str] = {}
    read: dict[str, Any] = {
        key: read_section(cls, tables.get(key, {}), name, key, origins) for key, cls in sections.items()
    }
    known = (*sections, *others)
    for section in sorted(set(tables) - {*known, *header}):
        raise TouchlineError(f"{name}: section [{section}] is not known; {did_you_mean(section, known)}")
    return read, origins, version_of(tables, name)


def version_of(tables: Mapping[str, Any], where: str) -> int:
    """The version in the tables of a file; `UNVERSIONED` without one.

    Raises:
        TouchlineError: it is not a whole number from 1.
    """
    version = tables.get(VERSION_KEY, UNVERSIONED)
    if VERSION_KEY in tables and (not isinstance(version, int) or isinstance(version, bool) or version < 1):
        raise TouchlineError(f"{where}: version is {version!r}; write a whole number from 1")
    return int(version)


def versioned_name(name: str, version: int) -> str:
    """Name and version for display: `msl (version 2)`."""
    return f"{name} (version {version})" if version != UNVERSIONED else name
