"""Ratings: known strengths are found again, intervals cover them, and an order needs enough matches."""

import random

import pytest

from touchline.matches.cup.match_result import MatchResult, scored
from touchline.matches.statistics.ratings import SCALE, Scored, holm, rate

pytest.importorskip("scipy", reason="ratings need scipy")


def matches(strengths: dict[str, float], number: int, seed: int) -> list[Scored]:
    """Matches of each pair, with results drawn from the model without draws."""
    drawn, teams = random.Random(seed), list(strengths)
    results = []
    for place, first in enumerate(teams):
        for second in teams[place + 1 :]:
            chance = 1 / (1 + 10 ** ((strengths[second] - strengths[first]) / 400))
            won = [drawn.random() < chance for _ in range(number)]
            results += [Scored((first, second), (1, 0) if one else (0, 1)) for one in won]
    return results


def test_with_two_teams_the_difference_is_the_logarithm_of_the_odds() -> None:
    results = [Scored(("a", "b"), (1, 0))] * 300 + [Scored(("a", "b"), (0, 1))] * 100
    ratings = rate(["a", "b"], results)
    assert ratings.order[0].difference == pytest.approx(SCALE * 1.0986, abs=2.5)
    assert [one.value for one in ratings.teams] == pytest.approx([95.4, -95.4], abs=1.5)
    assert ratings.significant


def test_teams_without_a_match_are_level_and_no_order_is_significant() -> None:
    ratings = rate(["a", "b", "c"], [])
    assert [one.value for one in ratings.teams] == [0.0, 0.0, 0.0]
    assert not ratings.significant and ratings.order[0].p == 1.0
    many = rate([f"team {number}" for number in range(40)], []).teams
    assert many[0].high == pytest.approx(1000, abs=20), "the prior: 1,000 points for 95 % of teams"


def test_a_team_that_won_every_match_has_a_finite_rating() -> None:
    ratings = rate(["a", "b"], [Scored(("a", "b"), (1, 0))] * 10)
    assert 100 < ratings.teams[0].value < 1500


def test_draws_bring_teams_together() -> None:
    wins = [Scored(("a", "b"), (1, 0))] * 5
    draws = [Scored(("a", "b"), (2, 2))] * 10
    assert rate(["a", "b"], wins + draws).order[0].difference < rate(["a", "b"], wins).order[0].difference


def test_forfeits_and_shoot_outs_decide_nothing_on_strength() -> None:
    forfeit = MatchResult(("a", "b"), (3, 0), forfeited_by=("b",))
    assert rate(["a", "b"], scored([forfeit] * 9)).teams[0].matches == 0
    level = MatchResult(("a", "b"), (1, 1), penalties=(5, 0))
    assert rate(["a", "b"], scored([level] * 9)).order[0].difference == pytest.approx(0, abs=1e-6)


def test_intervals_cover_the_true_rating_in_about_95_percent_of_80_repetitions() -> None:
    strengths = {"a": 150.0, "b": 50.0, "c": -40.0, "d": -160.0}
    covered = total = 0
    for seed in range(80):
        for one in rate(list(strengths), matches(strengths, 30, seed)).teams:
            covered += one.low <= strengths[one.team] <= one.high
            total += 1
    assert 0.93 <= covered / total <= 0.98


def test_a_false_order_of_equal_teams_is_significant_in_at_most_five_percent() -> None:
    equal = {"a": 0.0, "b": 0.0}
    false = sum(rate(["a", "b"], matches(equal, 40, seed)).significant for seed in range(200))
    assert false <= 18, "5 % of 200 are 10, give or take 3 each"


def test_the_order_of_the_teams_in_the_file_changes_no_rating() -> None:
    strengths = {"a": 100.0, "b": 0.0, "c": -100.0}
    results = matches(strengths, 20, 1)
    one, other = rate(["a", "b", "c"], results), rate(["c", "a", "b"], results)
    assert [rating.team for rating in one.teams] == [rating.team for rating in other.teams]
    assert [rating.value for rating in one.teams] == pytest.approx([rating.value for rating in other.teams], abs=0.01)


def test_holm_corrects_the_smallest_probability_most() -> None:
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    assert holm([]) == []
