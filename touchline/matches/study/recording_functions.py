"""A user's functions of a recording: responses besides the figures of `touchline stats`."""

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from recordings.reading.recording import open_recording
from robot_agent.loading.brain_loader import load_object
from schemas.errors import TouchlineError
from touchline.matches.study.match_figures import Value


def load_functions(paths: Mapping[str, str], folder: Path | None) -> dict[str, Callable[..., Any]]:
    """Name of a response → the function `module:function`, its module looked for like a brain's.

    Raises:
        TouchlineError: there is no such function.
    """
    found = {name: load_object(f'functions.{name} is "{path}"', path, folder)[0] for name, path in paths.items()}
    for name, one in found.items():
        if not callable(one):
            raise TouchlineError(f'functions.{name} is "{paths[name]}", which is {one!r}; name a function')
    return found


def measure(functions: Mapping[str, Callable[..., Any]], path: Path) -> dict[str, Value]:
    """The values of all functions for a recording.

    Raises:
        TouchlineError: a function raises, or returns anything but a number.
    """
    return {name: _value(name, function, path) for name, function in functions.items()}


def _value(name: str, function: Callable[..., Any], path: Path) -> Value:
    try:
        value = function(open_recording(path))
    except Exception as error:
        reason = f"{type(error).__name__}: {' '.join(str(error).split())}"
        raise TouchlineError(f"function {name}, recording {path}: {reason}; mend it and run the study again") from None
    if value is None or (isinstance(value, int | float) and math.isfinite(value)):
        return value
    raise TouchlineError(f"function {name} returned {value!r}; return a finite number, or None")
