"""The table of the page on the rules: situation, clause, rule, event and restart, and the test that shows it.

Every row is generated from what a rule has anyway: its row in `RULES`, its docstring, the kinds of events in its
module, and the tests that name it. A new rule needs no more than these.
"""

import ast
import inspect
import re
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from inspect import cleandoc
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

from schemas.soccer.game import EventKind
from sim_host.soccer.referee.rules import RULES, SHOOT_OUT, Rule

LABELS = ("Section", "Measures", "Not judged")
"""The labels that the docstring of every rule has, in this order, after the description of the rule."""
LAWS = {
    "match": "7",
    "restarts, throw-in": "15",
    "restarts, corner and goal kick": "16, 17",
    "restarts": "8, 13 to 17",
    "play, scoring": "10",
    "play": "12",
}
"""Subject at the beginning of `Section:` → FIFA's laws on it, the longest subject first."""
OURS = "ours"
"""The clause of what no rule book has."""
_RESTARTS = re.compile(
    r"\b(free kick|penalty|corner|goal kick|throw-in|kick-off|dropped|restart|goal counts|attempt ends)\b"
)
_KINDS_OF_RESTART = re.compile(r"\b(free kick|a penalty|corner|goal kick|throw-in|kick-off|dropped)\b")
_KIND = re.compile(r"EventKind\.(\w+)")
_TESTS = Path("tests") / "sim_host" / "soccer" / "referee"


class Row(NamedTuple):
    """One row of the table."""

    situation: str
    clause: str
    rule: str
    events: str
    restart: str
    test: str
    """Path of a test and its name, `path::name`; empty if no test names the rule."""


def rows() -> Iterator[Row]:
    """The rows of all rules, in the order in which they are asked."""
    for rule in (*RULES, *SHOOT_OUT):
        text, labelled = parts_of_rule(rule)
        yield Row(
            situation=_sentences(text)[0],
            clause=clause(labelled.get("Section", OURS)),
            rule=rule.name,
            events=", ".join(kind.value for kind in _kinds(sys.modules[rule.judge.__module__])),
            restart=" ".join(_restarts(text)),
            test=_tests().get(rule.name, ""),
        )


def not_judged() -> Iterator[tuple[str, str]]:
    """What each rule leaves open, and the rule."""
    for rule in (*RULES, *SHOOT_OUT):
        yield parts_of_rule(rule)[1].get("Not judged", "").rstrip("."), rule.name


def clause(section: str) -> str:
    """The section of a rule with FIFA's laws on its subject."""
    subject = section.removesuffix(".")
    if subject.startswith((OURS, "none")) or "has no such limit" in subject:
        return subject
    law = next((law for name, law in LAWS.items() if subject.startswith(name)), None)
    return subject if law is None else f"{subject} (FIFA {law})"


def parts_of_rule(rule: Rule) -> tuple[str, dict[str, str]]:
    """The parts of a rule's docstring: its description, and its labelled sentences."""
    return parts_of_module(sys.modules[rule.judge.__module__])


def parts_of_module(module: ModuleType) -> tuple[str, dict[str, str]]:
    """The parts of a module's docstring: its description, and its labelled sentences."""
    doc = cleandoc(module.__doc__ or "")
    text, labelled, label = [], dict[str, list[str]](), ""
    for line in doc.splitlines():
        found = next((name for name in LABELS if line.startswith(f"{name}: ")), None)
        if found is not None:
            label, line = found, line.removeprefix(f"{found}: ")
        if label:
            labelled.setdefault(label, []).append(line)
        else:
            text.append(line)
    return "\n".join(text).strip(), {name: " ".join(lines).strip() for name, lines in labelled.items()}


def _sentences(text: str) -> list[str]:
    return re.split(r"(?<=\.)\s+", " ".join(text.split()))


def _restarts(text: str) -> list[str]:
    """The sentences of a description that name a restart, or what becomes of a goal or a half.

    Of the first sentence, which is the situation, only what follows its name.
    """
    first, *others = _sentences(text)
    first = _capitalized(first.partition(": ")[2])
    chosen = [_capitalized(sentence.removeprefix("Otherwise ")) for sentence in others if _RESTARTS.search(sentence)]
    return [first, *chosen] if not chosen or _KINDS_OF_RESTART.search(first) else chosen


def _capitalized(sentence: str) -> str:
    return f"{sentence[:1].upper()}{sentence[1:]}"


@cache
def _kinds(module: ModuleType) -> tuple[EventKind, ...]:
    """The kinds of events that a rule's module, and the common parts that it imports, decide on."""
    found: dict[EventKind, None] = {}
    for node in ast.walk(ast.parse(inspect.getsource(module))):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "EventKind":
            found[EventKind[node.attr]] = None
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("sim_host.soccer.referee.rules."):
            imported = [getattr(sys.modules[str(node.module)], one.name) for one in node.names]
            for function in filter(inspect.isfunction, imported):
                found |= dict.fromkeys(EventKind[name] for name in _KIND.findall(inspect.getsource(function)))
    return tuple(found)


@cache
def _tests() -> dict[str, str]:
    """Rule → the first test that compares the rule of an event with its name, or has it as a case.

    Files that name many rules come first: they are about rules. A test that names the rule through a constant or a
    function of its file comes last.
    """
    root = Path(__file__).parents[2]
    files: list[tuple[str, list[tuple[str, str]]]] = []
    indirect: list[tuple[str, list[tuple[str, str]]]] = []
    for path in sorted((root / _TESTS).glob("test_*.py")):
        tree = ast.parse(path.read_text("utf-8"))
        files.append(((_TESTS / path.name).as_posix(), [*_cases(tree), *_comparisons(tree)]))
        indirect.append((files[-1][0], list(_mentions(tree))))
    files.sort(key=lambda file: -len({rule for _, rule in file[1]}))
    found: dict[str, str] = {}
    for where, named in [*files, *indirect]:
        for name, rule in named:
            found.setdefault(rule, f"{where}::{name}")
    return found


def _cases(tree: ast.Module) -> Iterator[tuple[str, str]]:
    """Name and rule of each case in a table `"name": Case("rule", …)`."""
    for table in ast.walk(tree):
        if isinstance(table, ast.Dict):
            for key, value in zip(table.keys, table.values, strict=True):
                if isinstance(key, ast.Constant) and isinstance(value, ast.Call) and value.args:
                    yield from ((str(key.value), rule) for rule in _strings(value.args[:1]))


def _comparisons(tree: ast.Module) -> Iterator[tuple[str, str]]:
    """Name of each test function and the strings that it compares with the rule of an event."""
    for function in tree.body:
        if isinstance(function, ast.FunctionDef) and function.name.startswith("test_"):
            for node in ast.walk(function):
                if isinstance(node, ast.Compare) and ".rule" in ast.unparse(node):
                    strings = _strings([node, *node.comparators])
                    yield from ((function.name, string) for string in strings)


def _mentions(tree: ast.Module) -> Iterator[tuple[str, str]]:
    """Name of a test, and the strings in what it compares or in the definitions of its file that it uses."""
    tests = [one for one in tree.body if isinstance(one, ast.FunctionDef) and one.name.startswith("test_")]
    used = [{one.id for one in ast.walk(test) if isinstance(one, ast.Name)} for test in tests]
    for definition in tree.body:
        if isinstance(definition, ast.FunctionDef):
            names = {definition.name} if definition not in tests else set()
        else:
            names = {one.id for one in ast.walk(definition) if isinstance(one, ast.Name) and _is_stored(one)}
        test = next((test for test, its in zip(tests, used, strict=True) if names & its), None)
        if test is not None:
            yield from ((test.name, string) for string in _strings([definition]))
    for test in tests:
        compared = [node for node in ast.walk(test) if isinstance(node, ast.Compare)]
        yield from ((test.name, string) for string in _strings(compared))


def _is_stored(name: ast.Name) -> bool:
    return isinstance(name.ctx, ast.Store)


def _strings(nodes: Iterable[ast.AST]) -> list[str]:
    inner = (one for node in nodes for one in ast.walk(node))
    return [one.value for one in inner if isinstance(one, ast.Constant) and isinstance(one.value, str)]
