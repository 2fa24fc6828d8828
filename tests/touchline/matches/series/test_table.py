"""What a terminal shows of a series."""

from dataclasses import fields, replace
from typing import Any

import pytest

from schemas.config.match_config import load_match
from touchline.matches.engine.outcome import Failed, FailureKind
from touchline.matches.series.match_row import FailedMatch, MatchRow, rows_of
from touchline.matches.series.plan import plan_series
from touchline.matches.series.summary import Figure, Longest
from touchline.matches.series.table import UNKNOWN, figure_rows, headline, longest_line
from touchline.matches.statistics.estimates import Estimate


@pytest.mark.parametrize(
    ("value", "percent", "cell"),
    [
        (None, False, UNKNOWN),
        (3, False, "3"),
        (Estimate(0.256, 0.1, 0.5), True, "25.6 (10.0 to 50.0) %"),
        (Estimate(0.256), True, "25.6 %"),
        (Estimate(1.234, 0.5, 2.0), False, "1.23 (0.50 to 2.00)"),
        (Estimate(10.0), False, "10.0"),
        (Estimate(100.4), False, "100"),
    ],
)
def test_a_figure_has_three_digits_and_its_interval(value: Estimate | int | None, percent: bool, cell: str) -> None:
    assert figure_rows([Figure("goals", (value, 1), percent)]) == [("goals", cell, "1")]


def row(**given: Any) -> MatchRow:
    plain = dict.fromkeys([one.name for one in fields(MatchRow)], 0) | {"seed": 7, "swapped": False}
    return MatchRow(**(plain | given))


def test_a_headline_counts_the_matches_that_failed_and_those_that_were_not_played() -> None:
    teams = {"teams.cyan.name": "Lions", "teams.magenta.name": "NuBot"}
    plan, intervals = plan_series(load_match(None, teams), [1, 2, 3, 4]), "in brackets: intervals of 95 %"
    failed = [FailedMatch(1, "", 1, False, "no idea")]
    assert headline(plan, [row()] * 4, []) == f"Lions – NuBot   4 matches; {intervals}"
    assert headline(plan_series(load_match(None, teams), [1]), [row()], []) == f"Lions – NuBot   1 match; {intervals}"
    assert headline(plan, [row()] * 2, failed) == f"Lions – NuBot   2 of 4 matches, 1 failed, 1 not played; {intervals}"


def test_a_series_that_goes_on_has_rows_of_the_matches_that_have_ended() -> None:
    plan = plan_series(load_match(None), [1, 2, 3])
    second = plan.matches[1].identity
    rows = rows_of(plan, {second: Failed(second, FailureKind.CRASHED, "no idea")})
    assert rows == [FailedMatch(2, second, 2, False, "no idea")]


def test_a_longest_time_names_its_match_if_there_was_one() -> None:
    longest = Longest("longest stuck", 2.25, row())
    assert longest_line(longest) == "longest stuck: 2.2 s (seed 7)"
    assert longest_line(replace(longest, row=row(swapped=True))) == "longest stuck: 2.2 s (seed 7, sides swapped)"
    assert longest_line(replace(longest, seconds=0.0)) == "longest stuck: 0.0 s"
