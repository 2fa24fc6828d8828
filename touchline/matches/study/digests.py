"""Digests of files and code, and the versions of all that computes a result."""

import hashlib
import json
import platform
from collections.abc import Iterable
from pathlib import Path

from robot_agent.loading.user_code import OWN_PACKAGES
from runtime.process.installed import installed_version
from schemas.side import Side
from schemas.wire.message import VERSION
from touchline.launch.confinement.team_code import team_code
from touchline.matches.engine.code_digest import code_digest, files_digest
from touchline.matches.study.cells import Cell

_PACKAGES = ("touchline", "pybullet", "numpy", "scipy", "pandas", "pyarrow", "matplotlib", "msgspec", "pydantic")
_LIBRARY = Path(__file__).resolve().parents[3]


def file_digest(path: Path) -> str:
    """The digest of a file's bytes."""
    return hashlib.blake2b(path.read_bytes(), digest_size=16).hexdigest()


def library_digest() -> str:
    """The digest of this library's code, shipped teams included."""
    return files_digest(_LIBRARY / package for package in OWN_PACKAGES)


def team_digests(cells: Iterable[Cell], brain_folder: Path | None) -> dict[str, str]:
    """Program of a team → the digest of its own files, for teams that are no part of this library."""
    found = dict[str, str]()
    for cell in cells:
        for side in Side:
            team = cell.config.team(side)
            if team_code(cell.config, side, brain_folder).own:
                found[team.brain or " ".join(team.program or ())] = code_digest(cell.config, side, brain_folder)
    return dict(sorted(found.items()))


def versions(engine: dict[str, str]) -> dict[str, object]:
    """The versions of this library, of Python, of packages and of what computes the world."""
    return {
        "protocol": VERSION,
        "python": platform.python_version(),
        "machine": platform.machine(),
        "packages": {package: installed_version(package) for package in _PACKAGES},
        "engine": engine,
    }


def as_text(content: object) -> str:
    """JSON with one key a line."""
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"
