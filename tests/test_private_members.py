"""No private member of another package is used, and few of ours by tests.

A new version of a package may change any private member without notice; a test that uses one of ours fails when the
code changes and its behaviour does not.
"""

import ast
import tomllib
from collections.abc import Iterator
from io import IOBase
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
OURS = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
FOLDERS = (*OURS, "benchmarks", "docs", "examples", "tests")
DOCUMENTED = {"__struct_config__", "_asdict", "_current_frames", "_exit", "_fields", "_make", "_replace"}
"""Of named tuples, `os` and `sys`: public in spite of their names."""
SPECIAL = {name for thing in (type, ast, ast.walk, list[int], IOBase, Exception()) for name in dir(thing)} | {
    "__all__",
    "__excepthook__",
    "__post_init__",
    "__signature__",
    "__slots__",
    "__metadata__",
    "__path__",
    "__struct_fields__",
}
"""Names with two underscores at both ends that Python or msgspec documents."""

MOST_OF_OURS = 40
"""Uses of our own private members by tests, beside those of a rig on itself; this number may only fall."""


def is_private(name: str) -> bool:
    return name.startswith("_") and name not in DOCUMENTED | SPECIAL


def is_own(node: ast.expr) -> bool:
    """Whether an expression is `self`, `cls` or `super()`."""
    called = node.func if isinstance(node, ast.Call) and not node.args else None
    return (isinstance(node, ast.Name) and node.id in ("self", "cls")) or (
        isinstance(called, ast.Name) and called.id == "super"
    )


def nodes_of(source: str) -> list[ast.AST]:
    return list(ast.walk(ast.parse(source)))


def defined(nodes: list[ast.AST]) -> set[str]:
    """Every name that a file defines, in a module, a class, or on `self`."""
    found = set()
    for node in nodes:
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            found.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            found.add(node.id)
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            found.add(node.attr if is_own(node.value) else "")
    return {name for name in found if not name.startswith("__")}


def private_names(nodes: list[ast.AST]) -> Iterator[tuple[int, str, bool]]:
    """Line and name of each private member that is used, and whether it may be one that this repository defines."""
    for node in nodes:
        may_be_ours = isinstance(node, (ast.Attribute, ast.Call))
        if isinstance(node, ast.Attribute):
            names: tuple[str, ...] = (node.attr,)
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] not in (*OURS, "__future__"):
            names = (*(node.module or "").split("."), *(alias.name for alias in node.names))
        elif isinstance(node, ast.Import):
            names = tuple(part for alias in node.names for part in alias.name.split("."))
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("getattr", "setattr"):
            name = node.args[1]
            names = (name.value,) if isinstance(name, ast.Constant) and isinstance(name.value, str) else ()
        else:
            continue
        yield from ((node.lineno, name, may_be_ours) for name in names if is_private(name))


@pytest.fixture(scope="module")
def uses() -> tuple[list[tuple[str, str]], list[str]]:
    """Places and private members of other packages, and those of ours that tests use.

    One module after the other: the syntax of all together takes 160 MB.
    """
    ours, found, by_tests = set(), [], []
    for path in (path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))):
        place, nodes = path.relative_to(ROOT), nodes_of(path.read_text("utf-8"))
        ours |= defined(nodes)
        found += [(f"{place}:{line}", *more) for line, *more in private_names(nodes)]
        if place.parts[0] == "tests":
            by_tests += [f"{place}:{line}: {name}" for line, name in names_of_ours(nodes)]
    return [(place, name) for place, name, may_be_ours in found if not (may_be_ours and name in ours)], by_tests


def test_no_private_member_of_another_package_is_used(uses):
    assert uses[0] == []


def called_name(call: ast.Call) -> str:
    """The last word of what is called; empty for what has no name."""
    function = call.func
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def names_of_ours(nodes: list[ast.AST]) -> Iterator[tuple[int, str]]:
    """Line and name of each private member that is taken from an object, imported, or replaced by its name."""
    for node in nodes:
        if isinstance(node, ast.Attribute):
            names: tuple[str, ...] = () if is_own(node.value) else (node.attr,)
        elif isinstance(node, ast.ImportFrom):
            names = tuple(alias.name for alias in node.names)
        elif isinstance(node, ast.Call) and called_name(node) in ("getattr", "setattr"):
            texts = [word.value for word in node.args if isinstance(word, ast.Constant) and isinstance(word.value, str)]
            names = tuple(text.rpartition(".")[2] for text in texts)
        else:
            continue
        yield from ((node.lineno, name) for name in names if is_private(name))


def test_tests_use_no_more_of_our_private_members_than_they_did(uses):
    assert len(uses[1]) <= MOST_OF_OURS, "\n".join(uses[1])


@pytest.mark.parametrize(
    "line",
    [
        "rig.host._outbox._sights",
        "from sim_host.soccer.referee.rules import _occasions, _rules_to_ask",
        'monkeypatch.setattr(module, "_SILENCE_S", 0.1)\nrig._x',
        'monkeypatch.setattr("coach_gateway.soccer.refbox.client._UNREAD", 1)\nbox._peers',
    ],
)
def test_each_use_of_our_private_members_counts(line):
    assert len(list(names_of_ours(nodes_of(line)))) == 2


@pytest.mark.parametrize(
    "line",
    [
        "writer._Writer__stream",
        "threading._unknown_hook()",
        "model.__pydantic_serializer__",
        "from mcap._chunk_builder import ChunkBuilder",
        "from mcap.writer import _unknown",
        "import _thread",
        'getattr(threading, "_unknown_hook")',
    ],
)
def test_the_search_finds_what_it_is_for(line):
    assert len(list(private_names(nodes_of(line)))) == 1
