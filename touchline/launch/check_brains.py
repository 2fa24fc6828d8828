"""Checks that the teams' brains and programs exist, without running their code."""

import ast
import importlib.util
import pkgutil
import shutil
import sys
from collections.abc import Iterator
from importlib.machinery import ModuleSpec
from pathlib import Path

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError, did_you_mean
from schemas.side import Side


def check_teams(config: MatchConfig) -> None:
    """Check that both teams' brains or programs exist, before any process is launched.

    Raises:
        TouchlineError: one does not exist; the message names its key in the match file.
    """
    here = str(Path.cwd())
    if here not in sys.path:
        sys.path.append(here)  # on the path of `python -m`, too
    for side in Side:
        team = config.team(side)
        if team.command is not None:
            _check_program(f"teams.{side.value}.command", team.command)
        elif team.brain is not None:
            _check_brain(f"teams.{side.value}.brain", team.brain)


def _check_program(key: str, command: list[str]) -> None:
    if not command:
        raise TouchlineError(f'{key} is empty; write it as ["program", "argument"]')
    if shutil.which(command[0]) is None:
        raise TouchlineError(f'{key} begins with "{command[0]}", which is not a program here; give its path')


def _check_brain(key: str, brain: str) -> None:
    module, _, name = brain.partition(":")
    found = _find(key, brain, module)
    if found.origin is None or not found.origin.endswith(".py"):
        return  # compiled, or a folder without code: only the agent can check it
    try:
        tree = ast.parse(Path(found.origin).read_bytes())
    except SyntaxError as error:
        raise TouchlineError(f'{key} is "{brain}"; {found.origin}, line {error.lineno}: {error.msg}') from None
    names = set(_names(tree.body))
    if name not in names and "*" not in names and "__getattr__" not in names:
        public = sorted(word for word in names if not word.startswith("_"))
        hint = did_you_mean(name, public) if public else "it defines no public names"
        raise TouchlineError(f'{key} is "{brain}"; {module} has no {name}; {hint}')


def _find(key: str, brain: str, module: str) -> ModuleSpec:
    places = [str(Path.cwd())]
    path = ""
    for part in module.split("."):
        path = f"{path}.{part}".lstrip(".")
        try:
            found = importlib.util.find_spec(path)
        except Exception as error:  # a package's own code, which may raise anything
            raise TouchlineError(f'{key} is "{brain}"; looking for {path} raised {error!r}') from error
        if found is None:
            known = [entry.name for entry in pkgutil.iter_modules(places)]
            hint = did_you_mean(part, known) if known else "put it into the current directory"
            raise TouchlineError(f'{key} is "{brain}"; there is no module {path}; {hint}')
        if path == module:
            return found
        places = list(found.submodule_search_locations or ())
    raise TouchlineError(f'{key} is "{brain}"; it names no module; write "module:Class"')


def _names(body: list[ast.stmt]) -> Iterator[str]:
    """The names bound at the top level of a module, including those within `if` and `try`."""
    for statement in body:
        match statement:
            case ast.ClassDef() | ast.FunctionDef() | ast.AsyncFunctionDef():
                yield statement.name
            case ast.Import() | ast.ImportFrom():
                for alias in statement.names:
                    yield alias.asname or alias.name.partition(".")[0]
            case ast.Assign():
                yield from (target.id for target in statement.targets if isinstance(target, ast.Name))
            case ast.AnnAssign(target=ast.Name(id=name)):
                yield name
            case ast.If() | ast.Try():
                yield from _names([*statement.body, *statement.orelse, *getattr(statement, "finalbody", [])])
                for handler in getattr(statement, "handlers", []):
                    yield from _names(handler.body)
            case _:
                continue
