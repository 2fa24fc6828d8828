"""Tables and tie-breaks on constructed results."""

from collections.abc import Iterable

from hypothesis import given
from hypothesis import strategies as st

from support.cup_results import played, result_of
from touchline.matches.cup.formats.round_robin import round_robin
from touchline.matches.cup.match_result import Fixture, FixtureResult, MatchResult
from touchline.matches.cup.standings import Points, Standing, sums
from touchline.matches.cup.tie_breaks import ORDERS, Ranking, table

CHINA = Ranking(order=ORDERS["china-sim-2020"])


def places(rows: Iterable[Standing]) -> str:
    return "".join(row.team for row in rows)


def test_a_win_is_three_points_and_a_draw_one() -> None:
    rows = sums("abc", [played("a", "b", (2, 1)), played("b", "c", (0, 0))], Points())
    assert {team: row.points for team, row in rows.items()} == {"a": 3, "b": 1, "c": 1}
    assert (rows["b"].played, rows["b"].won, rows["b"].drawn, rows["b"].lost) == (2, 0, 1, 1)
    assert (rows["b"].goals_for, rows["b"].goals_against, rows["b"].goal_difference) == (1, 2, -1)


def test_a_fixture_of_several_matches_counts_once_with_the_goals_of_all() -> None:
    fixture = Fixture("league 1", "league", 1, ("a", "b"), best_of=3)
    rows = sums("ab", [result_of(fixture, (1, 0), (0, 4), (1, 0))], Points())
    assert (rows["a"].points, rows["b"].points) == (3, 0)
    assert (rows["a"].goals_for, rows["a"].goals_against) == (2, 4)


def test_a_fixture_with_a_match_to_play_is_not_in_the_table() -> None:
    fixture = Fixture("league 1", "league", 1, ("a", "b"), best_of=2)
    assert sums("ab", [result_of(fixture, (1, 0))], Points())["a"].played == 0


def test_2016_goal_difference_precedes_goals_and_goals_precede_the_direct_match() -> None:
    results = [played("a", "b", (0, 1)), played("a", "c", (5, 0)), played("b", "c", (1, 3)), played("c", "d", (0, 0))]
    rows = table("abc", results[:3], Ranking())
    assert places(rows) == "abc", "differences are 4, -1 and -3"
    assert rows[0].decided_by == "goal difference"
    equal_difference = [played("a", "c", (4, 2)), played("b", "c", (3, 1)), played("b", "a", (0, 0))]
    rows = table("abc", equal_difference, Ranking())
    assert places(rows) == "abc" and rows[0].decided_by == "goals"


def test_2016_the_direct_match_decides_between_equal_differences_and_goals() -> None:
    results = [
        played("a", "b", (0, 1)),
        played("a", "c", (2, 1)),
        played("b", "c", (1, 2)),
        played("c", "d", (0, 0)),
        played("a", "d", (0, 0)),
        played("b", "d", (0, 0)),
    ]
    rows = table("abcd", results, Ranking())
    assert [(row.points, row.goal_difference, row.goals_for) for row in rows if row.team in "ab"] == [(4, 0, 2)] * 2
    assert places(rows).index("b") < places(rows).index("a")


def test_2016_a_three_way_tie_with_a_circle_of_wins_is_decided_by_the_technical_challenge() -> None:
    circle = [played("a", "b", (1, 0)), played("b", "c", (1, 0)), played("c", "a", (1, 0))]
    rows = table("abc", circle, Ranking(challenge={"b": 12.0, "c": 3.0}))
    assert places(rows) == "bca"
    assert [row.decided_by for row in rows] == ["challenge", "challenge", None]


def test_a_three_way_tie_that_the_direct_matches_split_begins_again_for_the_two_that_are_left() -> None:
    ranking = Ranking(order=("direct match",))
    level = [played("a", "b", (1, 0)), played("b", "a", (1, 0)), played("a", "c", (3, 0)), played("c", "b", (2, 0))]
    three = [*level, played("b", "x", (1, 0)), played("c", "x", (1, 0))]
    ordered = table("abcx", three, ranking)
    assert {row.team: row.points for row in ordered} == {"a": 6, "b": 6, "c": 6, "x": 0}
    assert places(ordered)[0] == "a", "six points among the three"
    assert places(ordered) == "acbx", "c and b have three points each; their direct match ended 2:0"


def test_china_2020_fewest_reds_precede_fewest_yellows_and_these_the_goal_difference() -> None:
    results = [
        played("a", "b", (0, 0), reds=(1, 0), yellows=(0, 0)),
        played("b", "c", (0, 0), yellows=(2, 1)),
        played("c", "a", (0, 0)),
    ]
    rows = table("abc", results, CHINA)
    assert places(rows) == "cba"
    assert [row.decided_by for row in rows] == ["fewest yellows", "fewest reds", None]
    by_goals = [played("a", "c", (2, 0)), played("b", "c", (3, 0)), played("a", "b", (0, 0))]
    assert places(table("abc", by_goals, CHINA)) == "bac"


def test_2016_fewer_matches_for_as_many_points_are_better() -> None:
    results = [played("a", "x", (1, 0)), played("a", "y", (0, 1)), played("b", "x", (1, 0))]
    assert places(table("abxy", results, Ranking())).index("b") < places(table("abxy", results, Ranking())).index("a")


def test_a_lot_decides_what_nothing_else_does_and_only_its_seed_changes_it() -> None:
    def order(teams: str, seed: int) -> str:
        return places(table(teams, [], Ranking(seed=seed)))

    assert order("abcd", 1) == order("dcba", 1)
    assert len({order("abcd", seed) for seed in range(20)}) > 5
    assert table("ab", [], Ranking())[0].decided_by == "lot"


def test_a_bye_gives_the_points_of_a_win_without_a_match() -> None:
    (first, second) = table("ab", [], Ranking(), byes=["b"])
    assert (first.team, first.points, first.played, first.byes) == ("b", 3, 0, 1)
    assert second.points == 0


GOALS = st.tuples(st.integers(0, 2), st.integers(0, 2))


@given(st.lists(GOALS, min_size=10, max_size=10), st.permutations("abcde"), st.sampled_from(sorted(ORDERS)))
def test_the_order_of_a_table_depends_neither_on_the_order_of_teams_nor_on_that_of_results(
    goals: list[tuple[int, int]], order: list[str], book: str
) -> None:
    fixtures = round_robin("abcde", "league")
    results = [result_of(one, score) for one, score in zip(fixtures, goals, strict=True)]
    ranking = Ranking(order=ORDERS[book])
    expected = table("abcde", results, ranking)
    assert places(table(order, results[::-1], ranking)) == places(expected)
    assert [row.points for row in expected] == sorted((row.points for row in expected), reverse=True)
    assert [row.place for row in expected] == [1, 2, 3, 4, 5]
    assert sum(row.goal_difference for row in expected) == 0


def test_a_match_that_both_teams_forfeit_is_lost_by_both() -> None:
    fixture = Fixture("league 1", "league", 1, ("a", "b"))
    result = FixtureResult(fixture, (MatchResult(("a", "b"), (0, 0), forfeited_by=("a", "b")),))
    assert [(row.points, row.drawn, row.lost) for row in table("ab", [result], Ranking())] == [(0, 0, 1)] * 2


def test_a_team_that_was_refused_is_last_whatever_the_others_have() -> None:
    results = [played("a", "b", (9, 0)), played("b", "a", (0, 9))]
    assert places(table("abcd", results, Ranking(), refused=("c",)))[-1] == "c"
    assert places(table("abc", results, Ranking(), refused=("c",))) == "abc"


def test_a_forfeit_counts_like_three_goals() -> None:
    fixture = Fixture("league 1", "league", 1, ("a", "b"))
    result = FixtureResult(fixture, (MatchResult(("a", "b"), (3, 0), forfeited_by=("b",)),))
    rows = table("ab", [result], Ranking())
    assert (rows[0].team, rows[0].points, rows[0].goals_for) == ("a", 3, 3)
