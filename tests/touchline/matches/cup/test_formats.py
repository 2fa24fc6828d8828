"""Formats on constructed results."""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from itertools import combinations
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support.cup_results import result_of, stronger_wins
from touchline.matches.cup.formats.groups import divided, seeded_from
from touchline.matches.cup.formats.knock_out import Vacancy, knock_out, seeded_places
from touchline.matches.cup.formats.round_robin import round_robin
from touchline.matches.cup.formats.swiss import most_rounds, swiss
from touchline.matches.cup.match_result import Fixture, FixtureResult, MatchResult
from touchline.matches.cup.tie_breaks import Ranking, table, winner_of


def names(number: int) -> list[str]:
    return [f"team {place:02}" for place in range(number)]


def by_leader(result: FixtureResult, _: object) -> tuple[str, None]:
    assert result.leader is not None
    return result.leader, None


@given(st.integers(2, 20))
def test_in_a_round_robin_each_pair_meets_once_and_no_team_plays_twice_in_a_round(number: int) -> None:
    fixtures = round_robin(names(number), "league")
    assert Counter(frozenset(one.teams) for one in fixtures) == Counter(map(frozenset, combinations(names(number), 2)))
    assert max(one.round for one in fixtures) == number - 1 + number % 2
    for place in range(1, number):
        of_round = [team for one in fixtures if one.round == place for team in one.teams]
        assert len(of_round) == len(set(of_round))


@given(st.integers(2, 20))
def test_in_a_round_robin_sides_are_balanced(number: int) -> None:
    fixtures = round_robin(names(number), "league")
    for team in names(number):
        cyan = sum(one.teams[0] == team for one in fixtures)
        assert abs(cyan - (number - 1 - cyan)) <= 1


@given(st.integers(2, 12))
def test_in_a_double_round_robin_each_pair_meets_once_on_each_side(number: int) -> None:
    fixtures = round_robin(names(number), "league", double=True)
    assert len({one.teams for one in fixtures}) == len(fixtures) == number * (number - 1)
    assert len({one.name for one in fixtures}) == len(fixtures)


def test_a_round_robin_that_is_repeated_swaps_sides_from_each_time_to_the_next() -> None:
    fixtures = round_robin(["a", "b"], "league", repeats=5)
    assert [one.teams for one in fixtures] == [("a", "b"), ("b", "a"), ("a", "b"), ("b", "a"), ("a", "b")]
    assert [one.round for one in fixtures] == [1, 2, 3, 4, 5]


def test_sides_are_swapped_in_each_second_match_of_a_fixture() -> None:
    fixture = Fixture("league 1", "league", 1, ("a", "b"), best_of=3)
    assert [fixture.sides(leg) for leg in range(3)] == [("a", "b"), ("b", "a"), ("a", "b")]


def test_a_decisive_best_of_five_ends_as_soon_as_a_team_cannot_be_caught_up_with() -> None:
    fixture = Fixture("final", "final", 1, ("a", "b"), best_of=5, decisive=True)
    assert list(FixtureResult(fixture).legs_to_play) == [0, 1, 2]
    assert list(result_of(fixture, (1, 0), (0, 2)).legs_to_play) == [2, 3]
    assert list(result_of(fixture, (1, 0), (0, 2), (1, 0)).legs_to_play) == [3]
    over = result_of(fixture, (1, 0), (2, 0), (1, 0))
    assert over.is_over and over.leader == "a" and over.wins == (3, 0)


def test_a_league_fixture_of_three_matches_plays_them_all() -> None:
    fixture = Fixture("league 1", "league", 1, ("a", "b"), best_of=3)
    assert list(result_of(fixture, (1, 0), (1, 0)).legs_to_play) == [2]


def test_penalties_decide_a_level_match_and_leave_its_goals() -> None:
    match = MatchResult(("a", "b"), (1, 1), penalties=(3, 4))
    assert match.winner == "b"
    assert MatchResult(("a", "b"), (1, 1), penalties=(3, 3)).winner is None


@given(st.integers(2, 40))
def test_seeds_are_placed_so_that_the_first_meet_last(number: int) -> None:
    places = seeded_places(number)
    assert sorted(place for place in places if place is not None) == list(range(number))
    half = len(places) // 2
    assert 0 in places[:half] and 1 in places[half:]
    pairs = list(zip(places[::2], places[1::2], strict=True))
    assert not any(one is None and other is None for one, other in pairs)
    byes = {one for one, other in pairs if other is None}
    assert byes == set(range(len(places) - number)), "the strongest teams have the byes"


@settings(max_examples=30)
@given(st.integers(2, 33), st.randoms())
def test_a_knock_out_ends_with_the_team_that_wins_all_and_each_other_loses_once(number: int, random: Random) -> None:
    order = names(number)
    random.shuffle(order)
    results: dict[str, FixtureResult] = {}
    while (bracket := knock_out(names(number), results, by_leader)).winner is Vacancy.OPEN:
        due = [one for one in bracket.fixtures if one.name not in results]
        assert due, "a fixture is always known until the winner is"
        results[due[0].name] = stronger_wins(due[0], order)
    assert bracket.winner == order[0]
    losers = [team for one in results.values() for team in one.fixture.teams if team != one.leader]
    assert sorted([*losers, order[0]]) == names(number)


def test_the_losers_of_the_semi_finals_meet_for_third_place() -> None:
    results: dict[str, FixtureResult] = {}
    for _ in range(2):
        for fixture in knock_out(names(4), results, by_leader, third_place=True).fixtures:
            results.setdefault(fixture.name, stronger_wins(fixture, names(4)))
    bracket = knock_out(names(4), results, by_leader, third_place=True)
    assert [one.name for one in bracket.fixtures] == ["semi-final 1", "semi-final 2", "third place", "final"]
    assert bracket.third_place is not None and set(bracket.third_place.teams) == {"team 02", "team 03"}
    assert bracket.third == "team 02" and bracket.third_place.decisive


def test_a_level_knock_out_is_decided_by_earlier_results_that_later_ones_do_not_change() -> None:
    ranking = Ranking()
    first = knock_out(names(4), {}, by_leader).fixtures
    results = {first[0].name: result_of(first[0], (5, 0)), first[1].name: result_of(first[1], (1, 0))}

    def winner(result: FixtureResult, earlier: Iterable[FixtureResult]) -> tuple[str, str | None]:
        return winner_of(result, list(earlier), ranking)

    final = knock_out(names(4), results, winner, third_place=True).fixtures[-1]
    results[final.name] = result_of(final, (2, 2))
    bracket = knock_out(names(4), results, winner, third_place=True)
    assert bracket.winner == "team 00", "five goals more than its opponent of the semi-final"
    third = bracket.third_place
    assert third is not None
    results[third.name] = result_of(third, (0, 9))
    assert knock_out(names(4), results, winner, third_place=True).winner == "team 00"


@pytest.mark.parametrize(
    ("semi_final", "criterion"), [((5, 0), "goal difference"), ((1, 0), "lot")], ids=["by goals", "by lot"]
)
def test_a_level_final_names_the_criterion_that_decided_it(semi_final: tuple[int, int], criterion: str) -> None:
    results: dict[str, FixtureResult] = {}
    for goals in (semi_final, (1, 0), (2, 2)):
        bracket = knock_out(names(4), results, lambda one, earlier: winner_of(one, list(earlier), Ranking()))
        due = next(one for one in bracket.fixtures if one.name not in results)
        results[due.name] = result_of(due, goals)
    bracket = knock_out(names(4), results, lambda one, earlier: winner_of(one, list(earlier), Ranking()))
    assert bracket.decided_by == {"final": criterion}


def forfeited_by_both(fixture: Fixture) -> FixtureResult:
    return FixtureResult(fixture, (MatchResult(fixture.teams, (0, 0), forfeited_by=fixture.teams),))


def test_where_both_teams_of_a_knock_out_forfeit_neither_goes_on() -> None:
    first, second = knock_out(names(4), {}, by_leader).fixtures
    results = {first.name: forfeited_by_both(first), second.name: stronger_wins(second, names(4))}
    bracket = knock_out(names(4), results, by_leader, third_place=True)
    assert [one.name for one in bracket.fixtures] == [first.name, second.name]
    assert bracket.winner == second.teams[0] == "team 01"
    assert bracket.third == "team 02"
    results[second.name] = forfeited_by_both(second)
    assert knock_out(names(4), results, by_leader).winner is Vacancy.BYE


def test_groups_are_divided_forth_and_back() -> None:
    assert divided(["1", "2", "3", "4", "5", "6"], 2) == {"group A": ["1", "4", "5"], "group B": ["2", "3", "6"]}


@pytest.mark.parametrize(("groups", "advance"), [(2, 2), (3, 2), (4, 2), (2, 4), (5, 2), (4, 1), (8, 2), (3, 3)])
def test_teams_of_a_group_do_not_meet_again_in_the_first_round_of_the_knock_out(groups: int, advance: int) -> None:
    tables = [[f"{group}{place}" for place in range(advance)] for group in "ABCDEFGH"[:groups]]
    first = knock_out(seeded_from(tables), {}, by_leader).rounds[0]
    met = [pair for pair in first if not any(isinstance(one, Vacancy) for one in pair)]
    assert all(str(one)[0] != str(other)[0] for one, other in met)


def test_tiers_in_which_teams_of_a_group_meet_again_in_any_order_are_seeded_all_the_same() -> None:
    tables = [[f"{group}{place}" for place in range(9)] for group in "ABCDEFG"]
    seeded = seeded_from(tables)
    assert seeded[:7] == [f"{group}0" for group in "ABCDEFG"] and len({*seeded}) == 63


def ranked(order: Sequence[str]) -> Callable[[Sequence[FixtureResult], Sequence[str]], list[str]]:
    return lambda results, byes: [row.team for row in table(order, results, Ranking(), byes)]


@settings(max_examples=20)
@given(st.integers(2, 17), st.randoms())
def test_in_a_swiss_tournament_no_pair_meets_twice_and_no_team_rests_twice(number: int, random: Random) -> None:
    teams, results = names(number), dict[str, FixtureResult]()
    while True:
        known = swiss(teams, most_rounds(number), results, ranked(teams))
        due = [one for one in known.fixtures if one.name not in results]
        if not due:
            break
        goals = [(1, 0), (0, 0), (0, 3)]
        results |= {one.name: result_of(one, random.choice(goals)) for one in due}
    pairs = [frozenset(one.teams) for one in known.fixtures]
    assert len(set(pairs)) == len(pairs) == number // 2 * most_rounds(number)
    assert len(set(known.byes)) == len(known.byes) == (most_rounds(number) if number % 2 else 0)
    for one in known.fixtures:
        cyan = Counter(other.teams[0] for other in known.fixtures if other.round < one.round)
        assert cyan[one.teams[0]] <= cyan[one.teams[1]], "who was in cyan less often is so now"


def test_a_swiss_tournament_of_28_teams_that_all_draw_is_paired_to_its_last_round() -> None:
    teams, results = names(28), dict[str, FixtureResult]()
    for _ in range(14):
        for fixture in swiss(teams, 14, results, lambda *_: teams).fixtures:
            results.setdefault(fixture.name, result_of(fixture, (0, 0)))
    assert len({frozenset(one.fixture.teams) for one in results.values()}) == 14 * 14


def test_in_a_swiss_tournament_winners_meet_winners() -> None:
    teams, results = names(8), dict[str, FixtureResult]()
    for _ in range(2):
        for fixture in swiss(teams, 3, results, ranked(teams)).fixtures:
            results.setdefault(fixture.name, stronger_wins(fixture, teams))
    third = [one.teams for one in swiss(teams, 3, results, ranked(teams)).fixtures if one.round == 3]
    assert frozenset(("team 00", "team 01")) in map(frozenset, third)


def test_a_round_of_a_swiss_tournament_waits_for_all_results_before_it() -> None:
    teams = names(4)
    first = swiss(teams, 2, {}, ranked(teams)).fixtures
    assert [one.teams for one in first] == [("team 00", "team 02"), ("team 01", "team 03")]
    half = {first[0].name: result_of(first[0], (1, 0))}
    assert len(swiss(teams, 2, half, ranked(teams)).fixtures) == 2
