"""Plays one match of a study in this process, measures it, and calls the user's functions with its recording."""

import math
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from recordings.reading.recording import open_recording
from robot_agent.brain_folders import BrainFolders
from schemas.errors import TouchlineError
from touchline.experiment.match_figures import flat_figures
from touchline.experiment.match_outcome import FailedMatch, MatchOutcome, PlayedMatch, Value
from touchline.experiment.study_plan import StudyMatch
from touchline.play import InProcessMatch
from touchline.series.play_planned import play_measured, reason_of
from touchline.series.processes import Poll


@dataclass(frozen=True, slots=True)
class MatchTask:
    """A match, and what the process that plays it needs beside."""

    match: StudyMatch
    brain_folder: Path | None
    """Where brains and functions are looked for first."""
    functions: Mapping[str, str]
    """Name of a response → `module:function`."""
    recording: Path | None
    """The recording that it leaves; None for none."""


def play_task(task: MatchTask, poll: Poll = lambda: None) -> MatchOutcome:
    """Play a match to its end; an exception of a brain or of a function makes it a failed match."""
    identity = task.match.identity
    try:
        functions = {name: function_of(path, task.brain_folder) for name, path in task.functions.items()}
        match = InProcessMatch(task.match.config, brain_folder=task.brain_folder)
    except TouchlineError as error:
        return FailedMatch(identity, str(error))
    with tempfile.TemporaryDirectory() as scratch:
        path = task.recording or (Path(scratch) / "match.mcap" if functions else None)
        try:
            figures = flat_figures(play_measured(match, path, poll))
            chain = match.simulation.now.applied["chain"]
        except (Exception, SystemExit) as error:
            return FailedMatch(identity, reason_of(match, error))
        finally:
            match.close()
        try:
            measured = {name: _measured(name, function, path) for name, function in functions.items() if path}
        except TouchlineError as error:
            return FailedMatch(identity, str(error))
    return PlayedMatch(identity, chain, figures | measured)


def function_of(path: str, folder: Path | None) -> Callable[..., Any]:
    """The function `module:function`, its module looked for in `folder` first.

    Raises:
        TouchlineError: there is no such function.
    """
    module, _, name = path.partition(":")
    try:
        BrainFolders(folder).add_to_module_path()
        found = getattr(import_module(module), name, None)
    except Exception as error:
        raise TouchlineError(f"function {path}: {type(error).__name__}: {error}") from None
    if not callable(found):
        raise TouchlineError(f"function {path}: {module} has no function {name}")
    function: Callable[..., Any] = found
    return function


def _measured(name: str, function: Callable[..., Any], path: Path) -> Value:
    try:
        value = function(open_recording(path))
    except Exception as error:
        raise TouchlineError(f"function {name}: {type(error).__name__}: {' '.join(str(error).split())}") from None
    if value is None or (isinstance(value, int | float) and math.isfinite(value)):
        return value
    raise TouchlineError(f"function {name} returned {value!r}; return a finite number, or None")
