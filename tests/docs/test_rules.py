"""The page on the rules is generated from this code, and documents each rule completely."""

from dataclasses import fields
from pathlib import Path

import pytest

from rules import DECIDED_BY_PEOPLE, PROCEDURES, page
from ruling_table import LABELS, clause, not_judged, parts_of_module, parts_of_rule, rows
from schemas.config.soccer.rule_book import SECTIONS, SHIPPED, load_rule_book
from sim_host.soccer.referee.rules import RULES, SHOOT_OUT

TEXT_ROOT = Path(__file__).parents[2]
TEXT = (TEXT_ROOT / "docs" / "rules.md").read_text("utf-8")
ALL = (*RULES, *SHOOT_OUT)


def test_the_page_is_fresh():
    assert page() == TEXT, "run: .venv/bin/python docs/generate/rules.py > docs/rules.md"


@pytest.mark.parametrize("rule", ALL, ids=lambda rule: rule.name)
def test_every_rule_documents_its_section_its_measures_and_what_it_does_not_judge(rule):
    text, labelled = parts_of_rule(rule)
    assert text and tuple(labelled) == LABELS and all(labelled.values())
    assert f"### `{rule.name}`" in TEXT and labelled["Measures"] in TEXT


@pytest.mark.parametrize("rule", ALL, ids=lambda rule: rule.name)
def test_every_rule_has_the_name_of_its_file_and_numbers_that_exist(rule):
    assert rule.judge.__module__.rsplit(".", 1)[1] == rule.name
    for number in rule.numbers:
        section, field = number.split(".")
        assert field in {one.name for one in fields(SECTIONS[section])}


@pytest.mark.parametrize("module", PROCEDURES, ids=lambda module: module.__name__)
def test_procedures_around_the_rules_are_documented_in_the_same_way(module):
    text, labelled = parts_of_module(module)
    assert text in TEXT and tuple(labelled) == LABELS and all(sentence in TEXT for sentence in labelled.values())


def test_every_foul_that_a_book_can_switch_belongs_to_a_rule():
    named = {number for rule in ALL for number in rule.numbers}
    assert {f"fouls.{one.name}" for one in fields(SECTIONS["fouls"])} <= named


@pytest.mark.parametrize("book", SHIPPED)
def test_every_number_of_every_book_stands_on_the_page_with_its_origin(book):
    for number, origin in load_rule_book(book).origins.items():
        assert origin in TEXT, number


def test_what_people_decide_is_listed():
    assert all(f"**{matter}.**" in TEXT for matter, _ in DECIDED_BY_PEOPLE)


@pytest.fixture(scope="module")
def rows_of_rules():
    return {row.rule: row for row in rows()}


@pytest.mark.parametrize("rule", ALL, ids=lambda rule: rule.name)
def test_every_situation_has_its_clause_its_event_its_restart_and_a_test_that_shows_it(rows_of_rules, rule):
    row = rows_of_rules[rule.name]
    assert row.situation and row.clause and row.events and row.restart
    path, _, name = row.test.partition("::")
    assert path, (
        f"no test in tests/sim_host/soccer/referee names the rule: compare `event.rule` with {row.rule!r} in one"
    )
    assert name in (TEXT_ROOT / path).read_text("utf-8")
    assert f"| {row.situation} | {row.clause} |" in TEXT


def test_what_rules_leave_open_stands_in_the_table():
    assert [rule for _, rule in not_judged()] == [rule.name for rule in ALL]
    assert all(f"| {matter} | `{rule}` |" in TEXT for matter, rule in not_judged())


@pytest.mark.parametrize(
    ("section", "named"),
    [
        ("play, scoring.", "play, scoring (FIFA 10)"),
        ("play, pushing.", "play, pushing (FIFA 12)"),
        ("restarts, throw-in.", "restarts, throw-in (FIFA 15)"),
        ("match.", "match (FIFA 7)"),
        ("ours.", "ours"),
        ("none; ours, since only a simulation can.", "none; ours, since only a simulation can"),
    ],
)
def test_a_clause_is_the_law_on_its_subject_or_ours(section, named):
    assert clause(section) == named
