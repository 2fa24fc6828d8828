"""The page on the rules: each rule by its own docstring, every number of every rule book, and what people decide.

`python -m sim_host.referee.document > docs/rules.md` writes it.
"""

import sys
from collections.abc import Iterable, Sequence
from dataclasses import fields
from inspect import cleandoc
from types import ModuleType
from typing import Any

from schemas.config.quantity import Quantity, meanings
from schemas.config.rule_book import SECTIONS, SHIPPED, RuleBook, load_rule_book
from sim_host.referee import authority
from sim_host.referee.placement import positions
from sim_host.referee.procedures import discipline, penalties, periods, restart
from sim_host.referee.rules import RULES, SHOOT_OUT, Rule

NOTE = (
    "<!-- Made by `python -m sim_host.referee.document > docs/rules.md`; what is to be changed is changed in "
    "sim_host/referee/rules/ and schemas/rule_books/. -->"
)
LABELS = ("Section", "Measures", "Not judged")
"""What the docstring of every rule says of itself, in this order, after what the rule is."""

INTRODUCTION = """
The referee looks at the truth of the world after every tick: poses and velocities of all bodies, contacts, kicks and
holds as the physics engine and the actuators report them. It never guesses who touched the ball. The first rule below
that decides in a tick is the only one to decide. Every decision is an event with the name of the rule, place, time,
robots, and the measured quantity beside its limit where there is one. Sections are those of the league's rule book by
their subject.

A number is chosen by the match's rule book: `touchline match --rules msl`. Each has a unit, an origin and a range, and
stands in `schemas/rule_books/`. A foul whose word is `off` is not called; with `yellow` the offender is shown a card.
"""

PROCEDURES = (periods, penalties, restart, positions, discipline, authority)
"""What happens around the rules, by the modules that do it; each says the same of itself as a rule does."""

DECIDED_BY_PEOPLE = (
    ("Advantage", "The referee stops the game at every foul. A person may have the last decision undone."),
    ("Intent", "Nobody's intent is judged: who moves an opponent has pushed it, who kicks from afar has shot."),
    (
        "Goal crash",
        "A robot that runs into a goal frame is not called (a yellow card in the simulation league of 2020).",
    ),
    ("Delay", "A program that stalls the game on purpose is not called; stalled balls, scrums and time limits are."),
    ("Handling", "How deep the ball lies in a hull is fixed by the robot's model and not judged."),
    ("Size, weight, markers, radio", "Robots are checked by their profile, and the radio's budget by the host."),
    ("Protests and abandoned matches", "People end a match by `end_game`."),
    ("Level after the shoot-out", "Fewest cards, goal difference and the coin are a tournament's matter."),
)
"""What the rule books leave to people, and what this referee does instead."""


def page() -> str:
    """The whole page, Markdown."""
    books = [load_rule_book(name) for name in SHIPPED]
    parts = [
        "# The rules",
        NOTE,
        cleandoc(INTRODUCTION),
        "## What is judged",
        "In the order in which the rules decide.",
        *(_rule(rule, books) for rule in RULES),
        "### In a penalty shoot-out",
        "There the rule below judges alone, and the end of time.",
        *(_rule(rule, books) for rule in SHOOT_OUT),
        "## The match around them",
        *(_procedure(module) for module in PROCEDURES),
        "## What people decide",
        "\n".join(f"* **{matter}.** {answer}" for matter, answer in DECIDED_BY_PEOPLE),
        "## Every number",
        *(_section(name, section, books) for name, section in SECTIONS.items()),
    ]
    return "\n\n".join(parts) + "\n"


def parts_of_rule(rule: Rule) -> tuple[str, dict[str, str]]:
    """What a rule's docstring says: what it is, then the labelled sentences."""
    return parts_of_module(sys.modules[rule.judge.__module__])


def parts_of_module(module: ModuleType) -> tuple[str, dict[str, str]]:
    """What a module's docstring says: what it is about, then the labelled sentences."""
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


def _rule(rule: Rule, books: Sequence[RuleBook]) -> str:
    text, labelled = parts_of_rule(rule)
    listed = "\n".join(f"* {label}: {sentence}" for label, sentence in labelled.items())
    return "\n\n".join([f"### `{rule.name}`", text, listed, *_numbers(rule.numbers, books)])


def _procedure(module: ModuleType) -> str:
    text, labelled = parts_of_module(module)
    listed = "\n".join(f"* {label}: {sentence}" for label, sentence in labelled.items())
    return "\n\n".join([f"### `{module.__name__.rpartition('.')[2]}`", text, listed])


def _numbers(numbers: Iterable[str], books: Sequence[RuleBook]) -> list[str]:
    rows = []
    for number in numbers:
        section, field = number.split(".")
        meaning = meanings(SECTIONS[section])[field]
        rows.append((f"`{number}`", *(_value(book, section, field) for book in books), _unit(meaning), meaning.meaning))
    return [_table(("number", *(book.name for book in books), "unit", "meaning"), rows)] if rows else []


def _section(name: str, section: type, books: Sequence[RuleBook]) -> str:
    known = meanings(section)
    rows = []
    for field in fields(section):
        meaning = known[field.name]
        values = tuple(_value(book, name, field.name) for book in books)
        rows.append((f"`{field.name}`", *values, _unit(meaning), _range(meaning), _origins(name, field.name, books)))
    head = ("number", *(book.name for book in books), "unit", "range", "origin")
    return f"### {name}\n\n{cleandoc(section.__doc__ or '')}\n\n{_table(head, rows)}"


def _origins(section: str, field: str, books: Sequence[RuleBook]) -> str:
    """Every origin once, with the books that have it when they differ."""
    by_origin: dict[str, list[str]] = {}
    for book in books:
        by_origin.setdefault(book.origins[f"{section}.{field}"], []).append(book.name)
    if len(by_origin) == 1:
        return next(iter(by_origin))
    return "; ".join(f"*{', '.join(names)}*: {origin}" for origin, names in by_origin.items())


def _value(book: RuleBook, section: str, field: str) -> str:
    value = getattr(getattr(book, section), field)
    return f"`{value}`" if isinstance(value, str) else f"{value:g}"


def _unit(meaning: Any) -> str:
    return meaning.unit if isinstance(meaning, Quantity) and meaning.unit != "1" else ""


def _range(meaning: Any) -> str:
    return f"{meaning.low:g} to {meaning.high:g}" if isinstance(meaning, Quantity) else ", ".join(meaning.options)


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)


if __name__ == "__main__":
    sys.stdout.write(page())
