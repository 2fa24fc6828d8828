"""A digest of a team's files: whether a team is the one that played before."""

import hashlib
from collections.abc import Iterable, Iterator
from importlib.metadata import version
from pathlib import Path

from schemas.config.match_config import MatchConfig
from schemas.side import Side
from touchline.launch.confinement.team_code import team_code

_CACHES = frozenset({"__pycache__", ".pytest_cache", ".mypy_cache", ".ruff_cache"})
_SKIPPED = _CACHES | {".git", ".venv", "runs"}
"""Folders whose content is no part of a team: what tools and matches leave."""


def code_digest(config: MatchConfig, side: Side, brain_folder: Path | None = None) -> str:
    """The digest of the files of a side's team: of its module, its package, or the files that its command names.

    A team that ships or is installed has the digest of this library's version: its files are a part of it.
    """
    team = config.team(side)
    named = team.brain or " ".join(team.program or ())
    own = team_code(config, side, brain_folder).own
    return files_digest(own, named if own else named + version("touchline"))


def files_digest(paths: Iterable[Path], name: str = "") -> str:
    """One digest of a name, and of files and all that is in folders, with their names."""
    digest = hashlib.blake2b(name.encode(), digest_size=16)
    for path in paths:
        for file in _files(path):
            content = file.read_bytes()
            digest.update(f"{file.relative_to(path.parent).as_posix()}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()


def _files(path: Path) -> Iterator[Path]:
    """The file itself, or the files below a folder, in order."""
    if path.is_file():
        yield path
        return
    for file in sorted(path.rglob("*")):
        if file.is_file() and not _SKIPPED.intersection(file.relative_to(path).parts):
            yield file
