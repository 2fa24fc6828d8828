"""Validation of TOML files: one line for the first fault, with file, key, value and remedy."""

import json
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from schemas.errors import TouchlineError, os_errors
from schemas.wire.faults import Fault
from schemas.wire.model_faults import fault_of

UNREADABLE = (ValueError, RecursionError)
"""What is raised for no TOML, no UTF-8, an integer of thousands of digits, and lists in lists in lists."""
FILE_KEYS = ("scene", "profile", "rules")
"""Keys of a match file that may name files."""
M = TypeVar("M", bound=BaseModel)


def from_folder(folder: Path, name: str) -> str:
    """The path of a file that a file in this folder names: from there, or else from the current directory."""
    found = folder / name
    return str(found) if name.endswith(".toml") and found.is_file() else name


def with_files(content: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Keys of a match file, with the paths of the files that a file in this folder names."""
    names = {key: content[key] for key in FILE_KEYS if isinstance(content.get(key), str)}
    return content | {key: from_folder(folder, name) for key, name in names.items()}


def read_tables(path: Path, kind: str) -> dict[str, Any]:
    """The content of a TOML file; `kind` says what it should be: `a match file`.

    Raises:
        TouchlineError: there is no such file, or it is not TOML.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise TouchlineError(f"{path}: a pipe or a device; give the path of {kind}")
    try:
        with os_errors(path, f"give the path of {kind}"):
            return tomllib.loads(path.read_text("utf-8"))
    except UNREADABLE as error:
        raise TouchlineError(f"{path}: not TOML: {error}") from None


def validate_tables(model: type[M], content: Mapping[str, Any], where: str, remedies: Mapping[str, str]) -> M:
    """The model of the content of a TOML file; `where` names the file.

    Args:
        remedies: key without indices of lists, `robots.side` → remedy for an invalid value.

    Raises:
        TouchlineError: the first fault.
    """
    try:
        return model.model_validate_json(json.dumps(content, default=str), strict=True)
    except ValidationError as error:
        raise table_error(fault_of(error, model), where, remedies) from None


def table_error(fault: Fault, where: str, remedies: Mapping[str, str]) -> TouchlineError:
    """The error for a fault of tables; arguments as of `validate_tables`."""
    remedy = remedies.get(re.sub(r"\.\d+(?=\.|$)", "", fault.where), "")
    return TouchlineError(f"{where}: {fault.sentence(remedy)}")
