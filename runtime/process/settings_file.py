"""Settings of a process as JSON: written for it by a supervisor, read by `python -m X --settings FILE`."""

import argparse
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from runtime.process.process_log import Level, log_line
from runtime.process.whole_file import written_whole
from schemas.config.settings import Settings
from schemas.config.toml_file import validate_tables
from schemas.errors import TouchlineError, os_errors

S = TypeVar("S", bound=Settings)

STANDARD_INPUT = "-"
"""The name of standard input in place of a file."""
WRONG = 2
"""Exit status of a process with invalid settings, or one that cannot begin."""


def write_settings(settings: Settings, path: Path) -> None:
    """Write a settings file that only its owner may read.

    Raises:
        OSError: the file cannot be written.
        TouchlineError: the settings have a path that is no UTF-8.
    """
    try:
        with written_whole(path, private=True) as draft:
            draft.write_text(settings.model_dump_json(indent=2) + "\n", "utf-8")
    except ValueError as error:
        raise TouchlineError(f"a path, as of the current folder, is no UTF-8; rename that ({error})") from None


def read_settings(model: type[S], source: str) -> S:
    """The settings in a file, or on standard input where `source` is `-`.

    Raises:
        TouchlineError: the file cannot be read, is not JSON, or has an invalid field.
    """
    name = "standard input" if source == STANDARD_INPUT else source
    try:
        with os_errors(f"--settings {source}", "give the path of a settings file"):
            content = json.loads(sys.stdin.read() if source == STANDARD_INPUT else Path(source).read_text("utf-8"))
    except ValueError as error:
        raise TouchlineError(f"{name}: not JSON: {error}") from None
    if not isinstance(content, dict):
        raise TouchlineError(f"{name}: not settings; write a JSON object of {', '.join(model.model_fields)}")
    return validate_tables(model, content, name, {})


def run_process(package: str, model: type[S], run: Callable[[S], int], arguments: list[str] | None = None) -> int:
    """Run `python -m PACKAGE --settings FILE`; returns the exit status of the process."""
    parser = argparse.ArgumentParser(prog=f"python -m {package}", description=model.__doc__, allow_abbrev=False)
    keys = f"{', '.join(model.model_fields)}; {STANDARD_INPUT} reads standard input"
    parser.add_argument("--settings", required=True, metavar="FILE", help=f"JSON object: {keys}")
    source: str = parser.parse_args(arguments).settings
    return exit_status(lambda: run(read_settings(model, source)))


def exit_status(run: Callable[[], int]) -> int:
    """The result of `run`; a `TouchlineError` is written to stderr in one line, with status 2."""
    try:
        return run()
    except TouchlineError as error:
        log_line(str(error), Level.ERROR, prefix="touchline: ")
        return WRONG
