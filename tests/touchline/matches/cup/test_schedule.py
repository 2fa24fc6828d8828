"""The schedule of a cup follows from its format and the results so far."""

import pytest

from support.cup_results import stronger_wins
from touchline.matches.cup import schedule as cup_schedule
from touchline.matches.cup.cup_config import CupConfig, FormatConfig, SignificanceConfig, TeamEntry
from touchline.matches.cup.match_result import FixtureResult
from touchline.matches.cup.schedule import Schedule, look_level, schedule_of
from touchline.matches.statistics.ratings import rate


def cup_of(number: int, **keys: object) -> CupConfig:
    until = keys.pop("until_significant", None)
    teams = [TeamEntry(name=f"t{place}", brain="simple") for place in range(number)]
    return CupConfig(teams=teams, format=FormatConfig(**keys), until_significant=until)  # type: ignore[arg-type]


def play_out(cup: CupConfig, order: list[str]) -> tuple[Schedule, dict[str, FixtureResult]]:
    """Play the cup with matches that the team before the other in the order wins."""
    results: dict[str, FixtureResult] = {}
    while due := [one for one in schedule_of(cup, results).fixtures if one.name not in results]:
        results |= {one.name: stronger_wins(one, order) for one in due}
    return schedule_of(cup, results), results


def test_groups_go_on_to_a_knock_out_between_the_first_of_each() -> None:
    cup = cup_of(6, kind="groups")
    assert len(schedule_of(cup, {}).fixtures) == 6, "no knock-out is known before the groups are over"
    schedule, results = play_out(cup, cup.names[::-1])
    assert [row.team for row in schedule.tables["group A"]] == ["t4", "t3", "t0"]
    assert [one.name for one in schedule.fixtures[6:]] == ["semi-final 1", "semi-final 2", "third place", "final"]
    assert schedule.bracket is not None and schedule.bracket.winner == "t5"
    assert len(results) == 10


def test_a_knock_out_of_three_teams_gives_the_first_a_bye() -> None:
    schedule, results = play_out(cup_of(3, kind="knock-out", best_of=3), ["t2", "t0", "t1"])
    assert [one.name for one in schedule.fixtures] == ["semi-final 2", "final"]
    assert schedule.bracket is not None and schedule.bracket.winner == "t2"
    assert all(one.wins in ((2, 0), (0, 2), (3, 0), (0, 3)) for one in results.values())


def test_a_swiss_cup_ends_after_its_rounds() -> None:
    schedule, results = play_out(cup_of(5, kind="swiss", rounds=3), ["t0", "t1", "t2", "t3", "t4"])
    assert len(results) == 6 and max(one.round for one in schedule.fixtures) == 3
    assert sum(row.byes for row in schedule.tables["swiss"]) == 3


def test_until_significant_looks_once_at_each_round_until_the_order_is_clear(monkeypatch: pytest.MonkeyPatch) -> None:
    looks: list[int] = []
    monkeypatch.setattr(cup_schedule, "rate", lambda *of: looks.append(len(of[1])) or rate(*of))
    cup = cup_of(2, until_significant=SignificanceConfig(budget=40))
    schedule, _ = play_out(cup, ["t1", "t0"])
    assert 6 < len(schedule.fixtures) < 40
    assert looks == list(range(1, len(schedule.fixtures) + 1))


def test_until_significant_never_plays_more_than_its_budget() -> None:
    cup = cup_of(3, until_significant=SignificanceConfig(budget=10))
    schedule, _ = play_out(cup, ["t0", "t1", "t2"])
    assert len(schedule.fixtures) == 9


def test_each_look_at_the_ratings_has_a_share_of_the_level() -> None:
    assert look_level(1) == pytest.approx(0.95)
    assert look_level(10) == pytest.approx(0.995)
