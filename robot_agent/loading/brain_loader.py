"""Loads a brain from `module:name` and checks it: one line names the fault, the file and line, and the remedy."""

import importlib
import inspect
import pkgutil
import sys
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any

from robot_agent.loading.brain_folders import BrainFolders
from robot_agent.loading.limit_reached import limit_reached
from robot_agent.loading.user_code import OWN_PACKAGES, definition_of, place_of, sentence_of
from robot_agent.sdk.contract import Brain, Briefing
from schemas.config.shipped_teams import POLICY_BRAIN, brain_of, policy_file, wrong_team
from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.command import Command
from schemas.messages.sight import Sight


class _FunctionBrain:
    """A brain that is a plain function."""

    def __init__(self, function: Callable[[Sight], Command]) -> None:
        self.act = function


def load_object(said: str, spec: str, beside: Path | None = None, here: Path | None = None) -> tuple[Any, str]:
    """The object that `module:name` names, and its name; `said` is what the user has written, for messages.

    Modules are also looked for in the folder `beside`, and then in the current directory, or in `here`.

    Raises:
        TouchlineError: one line with the wrong part of the spec, or with what the import raised, and where.
    """
    module_name, _, name = spec.partition(":")
    folders = BrainFolders(beside, here)
    folders.add_to_module_path()
    module = _import(said, module_name, folders)
    _check_origin(said, module, folders)
    found = getattr(module, name, None)
    if found is None:
        public = [word for word, value in vars(module).items() if callable(value) and not word.startswith("_")]
        hint = did_you_mean(name, public) if public else "it defines no public names"
        raise TouchlineError(f"{said}; {module_name} has no {name}; {hint}")
    return found, name


def load_brain(spec: str, briefing: Briefing, beside_match: Path | None = None, here: Path | None = None) -> Brain:
    """The brain that `module:name` names, or that of a shipped team: a class built with the briefing, or a function
    `act(sight)`; or the brain that plays the policy of `policy:FILE`.

    Modules and files are looked for in `beside_match`, the folder of the match file, and then in the current
    directory, or in `here` where the process has left that.

    Raises:
        TouchlineError: one line with the wrong part of the spec, or with what its code raised, and where.
    """
    said = f'brain is "{spec}"'
    if remedy := wrong_team(spec):
        raise TouchlineError(f"{said}; {remedy}")
    if file := policy_file(spec):
        return _policy_brain(said, file, briefing, beside_match, here)
    found, name = load_object(said, brain_of(spec), beside_match, here)
    if not isinstance(found, type):
        if not callable(found):
            raise TouchlineError(f"{said}; {name} is {found!r}; name a class or a function act(sight)")
        _check_act(said, found, f"{name}(sight)", f"def {name}(sight)")
        return _FunctionBrain(found)
    return _build(said, found, briefing)


def _policy_brain(said: str, file: str, briefing: Briefing, beside: Path | None, here: Path | None) -> Brain:
    """The brain of a policy; its class is imported here alone, because policies stand above the robots' packages."""
    folders = BrainFolders(beside, here)
    found = folders.find(file)
    if found is None:
        raise TouchlineError(f"{said}; there is no file {file} {folders}; put it there")
    module, _, name = POLICY_BRAIN.partition(":")
    try:
        made = getattr(importlib.import_module(module), name)
        brain: Brain = made.of_file(briefing, found, lambda spec: load_brain(spec, briefing, beside, here))
    except TouchlineError as error:
        raise TouchlineError(f"{said}; {error}") from error
    return brain


def _build(said: str, cls: type, briefing: Briefing) -> Brain:
    if not callable(getattr(cls, "act", None)):
        where = definition_of(cls)
        raise TouchlineError(f"{said}; {cls.__name__}{where} has no method act(self, sight); write one")
    if not _takes(cls, briefing):
        where = definition_of(vars(cls).get("__init__", cls)) or definition_of(cls)
        raise TouchlineError(
            f"{said}; {cls.__name__}.__init__{where} does not take the briefing alone; "
            "write def __init__(self, briefing)"
        )
    try:
        brain: Brain = cls(briefing)
    except (Exception, SystemExit) as error:
        call = f"{cls.__name__}(briefing)"
        raise TouchlineError(f"{said}; {call} raised {_one_line(error)} for {briefing.robot}") from error
    _check_act(said, brain.act, f"{cls.__name__}.act", "def act(self, sight)")
    return brain


def _check_act(said: str, act: Callable[..., Any], name: str, remedy: str) -> None:
    """Check that `act` can be called with a sight, and returns without being awaited."""
    if inspect.iscoroutinefunction(act) or inspect.isasyncgenfunction(act):
        raise TouchlineError(f"{said}; {name}{definition_of(act)} is async; write {remedy} without async")
    if inspect.isgeneratorfunction(act):
        raise TouchlineError(f"{said}; {name}{definition_of(act)} yields; return one Command")
    if not _takes(act, None):
        raise TouchlineError(f"{said}; {name}{definition_of(act)} does not take the sight alone; write {remedy}")


def _takes(function: Callable[..., Any], argument: object) -> bool:
    """Whether a function can be called with one positional argument; true if its signature is unknown."""
    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):
        return True
    try:
        signature.bind(argument)
    except TypeError:
        return False
    return True


def _import(said: str, module_name: str, folders: BrainFolders) -> ModuleType:
    importlib.invalidate_caches()
    try:
        return importlib.import_module(module_name)
    except ImportError as error:
        package = (error.name or "").partition(".")[0]
        own = folders.file_of(package) if package in OWN_PACKAGES else None
        if own is not None and Path(sys.modules[package].__file__ or "").resolve() != own.resolve():
            fault = f"{said}; importing {module_name} raised {_one_line(error)}"
            raise TouchlineError(f"{fault}; {package} is Touchline's, not {own}; rename that file") from error
        if not isinstance(error, ModuleNotFoundError):
            raise TouchlineError(f"{said}; importing {module_name} raised {_one_line(error)}") from error
        missing = error.name or module_name
        if module_name != missing and not module_name.startswith(missing + "."):
            raise TouchlineError(
                f"{said}; {module_name} imports {missing}, which is not installed; install it"
            ) from error
        parent, _, last = missing.rpartition(".")
        if parent:
            _check_origin(said, importlib.import_module(missing.partition(".")[0]), folders)
        where = "" if parent else f" {folders}"
        known = _modules_in(parent, folders)
        hint = did_you_mean(last, known) if known else f"{parent} has no modules" if parent else "put its file there"
        raise TouchlineError(f"{said}; there is no module {missing}{where}; {hint}") from None
    except (Exception, SystemExit) as error:
        raise TouchlineError(f"{said}; importing {module_name} raised {_one_line(error)}") from error


def _check_origin(said: str, module: ModuleType, folders: BrainFolders) -> None:
    """Check that a module is the user's where the folders of brains have a file of its name.

    Raises:
        TouchlineError: a module of Python or of an installed package has the same name.
    """
    meant = folders.file_of(module.__name__)
    loaded = getattr(module, "__file__", None) or "built into Python"
    if meant is None or module.__name__.partition(".")[0] in OWN_PACKAGES or Path(loaded).resolve() == meant.resolve():
        return
    raise TouchlineError(f"{said}; the module {module.__name__} is {loaded}, not {meant}; rename that file")


def _modules_in(package: str, folders: BrainFolders) -> list[str]:
    """The modules of a package; without a package, those of the folders of brains."""
    places: Any = [str(path) for path in folders.paths]
    if package:
        spec = find_spec(package)
        places = spec.submodule_search_locations if spec is not None else None
    return [module.name for module in pkgutil.iter_modules(places or [])]


def _one_line(error: BaseException) -> str:
    """An exception in one line, with the place in the brain's own code."""
    if isinstance(error, SyntaxError):
        return f"SyntaxError: {error.msg} ({error.filename}, line {error.lineno})"
    limit = limit_reached(error)
    remedy = f"; limit reached: {limit}" if limit else ""
    return f"{sentence_of(error)}{place_of(error)}{remedy}"
