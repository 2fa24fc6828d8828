"""Constructed results for tests of tables and formats."""

from collections.abc import Sequence

from touchline.matches.cup.match_result import Fixture, FixtureResult, MatchResult, Pair


def played(first: str, second: str, goals: Pair, *, reds: Pair = (0, 0), yellows: Pair = (0, 0)) -> FixtureResult:
    """A fixture of one match."""
    fixture = Fixture(f"{first} {second}", "league", 1, (first, second))
    return FixtureResult(fixture, (MatchResult((first, second), goals, reds=reds, yellows=yellows),))


def result_of(fixture: Fixture, *goals: tuple[int, int]) -> FixtureResult:
    """These matches of a fixture; goals are in the order of its teams."""
    return FixtureResult(fixture, tuple(MatchResult(fixture.teams, one) for one in goals))


def stronger_wins(fixture: Fixture, order: Sequence[str]) -> FixtureResult:
    """A fixture whose matches the team that stands first in the order wins by one goal."""
    first, second = fixture.teams
    goals = (1, 0) if order.index(first) < order.index(second) else (0, 1)
    return result_of(fixture, *[goals] * fixture.best_of)
