"""What a brain is, its briefing before the match, and how it is loaded from `module:name`."""

import importlib
import pkgutil
import sys
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.side import Side


class Brain(Protocol):
    """Controls one robot. Everything in and out is in the team frame, which attacks +x."""

    def act(self, sight: Sight) -> Command:
        """The command for one sight; called once for each tick, in order."""


@dataclass(frozen=True, slots=True)
class Briefing:
    """What a brain knows before its first sight."""

    robot: str
    side: Side
    number: int
    """Place in the team's list, from 1; 1 is the goalkeeper, in a team that has one."""
    teammates: tuple[str, ...]
    """The others of the team, in the order of the list."""
    setup: Setup
    """The match, with the numbers of this robot's own model: body, drive, dribbler, kicker."""

    @classmethod
    def of(cls, robot: str, setup: Setup) -> "Briefing":
        """The briefing of one robot of a match.

        Raises:
            TouchlineError: no robot of that name is in the match.
        """
        for side, team in setup.teams.items():
            if robot in team.robots:
                mates = tuple(name for name in team.robots if name != robot)
                return cls(robot, side, team.robots.index(robot) + 1, mates, setup.for_robot(robot))
        names = [name for team in setup.teams.values() for name in team.robots]
        raise TouchlineError(f'robot is "{robot}", which is not in match "{setup.match}"; {did_you_mean(robot, names)}')


class _FunctionBrain:
    """A brain that is a plain function."""

    def __init__(self, function: Callable[[Sight], Command]) -> None:
        self._function = function

    def act(self, sight: Sight) -> Command:
        return self._function(sight)


def load_brain(spec: str, briefing: Briefing) -> Brain:
    """The brain that `module:name` names: a class built with the briefing, or a function `act(sight)`.

    Modules are also looked for in the current directory.

    Raises:
        TouchlineError: one line with the wrong part of the spec, or with what its code raised, and where.
    """
    module_name, _, name = spec.partition(":")
    if not all(part.isidentifier() for part in (*module_name.split("."), name)):
        raise TouchlineError(f'brain is "{spec}"; write it as "module:Class"')
    here = str(Path.cwd())
    if here not in sys.path and "" not in sys.path:
        sys.path.append(here)
    module = _import(spec, module_name)
    found = getattr(module, name, None)
    if found is None:
        public = [word for word, value in vars(module).items() if callable(value) and not word.startswith("_")]
        raise TouchlineError(f'brain is "{spec}"; {module_name} has no {name}; {did_you_mean(name, public)}')
    if not isinstance(found, type):
        if not callable(found):
            raise TouchlineError(f'brain is "{spec}"; {name} is {found!r}; name a class or a function act(sight)')
        return _FunctionBrain(found)
    return _build(spec, found, briefing)


def _build(spec: str, cls: type, briefing: Briefing) -> Brain:
    if not callable(getattr(cls, "act", None)):
        raise TouchlineError(f'brain is "{spec}"; {cls.__name__} has no method act(self, sight); write one')
    try:
        brain: Brain = cls(briefing)
    except Exception as error:
        raise TouchlineError(f'brain is "{spec}"; {cls.__name__}(briefing) raised {_one_line(error)}') from error
    return brain


def _import(spec: str, module_name: str) -> ModuleType:
    importlib.invalidate_caches()
    try:
        return importlib.import_module(module_name)
    except ModuleNotFoundError as error:
        missing = error.name or module_name
        if module_name != missing and not module_name.startswith(missing + "."):
            raise TouchlineError(
                f'brain is "{spec}"; {module_name} imports {missing}, which is not installed; install it'
            ) from error
        parent, _, last = missing.rpartition(".")
        raise TouchlineError(
            f'brain is "{spec}"; there is no module {missing}; {did_you_mean(last, _modules_in(parent))}'
        ) from None
    except Exception as error:
        raise TouchlineError(f'brain is "{spec}"; importing {module_name} raised {_one_line(error)}') from error


def _modules_in(package: str) -> list[str]:
    """The modules of a package; without a package, those of the current directory."""
    places: Any = [str(Path.cwd())]
    if package:
        spec = find_spec(package)
        places = spec.submodule_search_locations if spec is not None else None
    return [module.name for module in pkgutil.iter_modules(places or [])]


def _one_line(error: Exception) -> str:
    """An exception in one line, with the place in the brain's own code."""
    if isinstance(error, SyntaxError):
        return f"SyntaxError: {error.msg} ({error.filename}, line {error.lineno})"
    last = traceback.extract_tb(error.__traceback__)[-1]
    what = " ".join(str(error).split())
    return f"{type(error).__name__}: {what} ({Path(last.filename).name}, line {last.lineno})"
