"""The figures of a series, from rows made by hand."""

from types import SimpleNamespace
from typing import Any

from pytest import approx

from schemas.side import Side
from touchline.matches.engine.outcome import Played
from touchline.matches.series.match_row import MatchRow, TeamRow, row_of
from touchline.matches.series.summary import Figure, Summary, summary_of
from touchline.matches.statistics.estimates import Estimate, student_t


def team(goals: int = 0, **figures: float) -> TeamRow:
    plain = {
        "passes": 0,
        "passes_completed": 0,
        "shots": 0,
        "shots_on_goal": 0,
        "saves": 0,
        "fouls": 0,
        "cards": 0,
        "possession_s": 0.0,
        "field_robots": 4,
        "field_distance": 0.0,
    }
    return TeamRow(goals=goals, **(plain | figures))  # type: ignore[arg-type]


def row(
    number: int, first: TeamRow, second: TeamRow, *, seed: int | None = None, swapped: bool = False, **figures
) -> MatchRow:
    plain = {
        "playing_time": 600.0,
        "in_play_s": 300.0,
        "crowded_s": 0.0,
        "longest_crowd_s": 0.0,
        "longest_stuck_s": 0.0,
    }
    return MatchRow(
        number=number,
        identity="",
        seed=seed if seed is not None else number,
        swapped=swapped,
        teams=(first, second),
        chain="",
        **(plain | figures),
    )


def named(figures: list[Figure], name: str) -> Figure:
    return next(figure for figure in figures if figure.name == name)


def estimate(summary: Summary, name: str, which: int = 0) -> Estimate:
    value = named([*summary.teams, *summary.match], name).values[which]
    assert isinstance(value, Estimate)
    return value


def test_a_draw_is_half_a_point_for_each_team() -> None:
    rows = [row(1, team(2), team(1)), row(2, team(1), team(1)), row(3, team(3), team(0)), row(4, team(0), team(1))]
    summary = summary_of(rows)
    assert [named(summary.teams, name).values for name in ("won", "drawn", "lost")] == [(2, 1), (1, 1), (1, 2)]
    points = "share of points, draws half"
    assert estimate(summary, points).value == approx(2.5 / 4)
    assert estimate(summary, points, 1).value == approx(1.5 / 4)


def test_results_by_side_follow_the_swapped_teams() -> None:
    summary = summary_of([row(1, team(2), team(0)), row(2, team(3), team(0), seed=1, swapped=True)])
    assert named(summary.teams, "won").values == (2, 0)
    assert named(summary.sides, "won").values == (1, 1)


def test_rates_are_of_the_playing_time() -> None:
    rows = [row(1, team(passes=20, passes_completed=15), team(), playing_time=300.0)]
    summary = summary_of(rows)
    assert estimate(summary, "passes completed a minute").value == approx(3.0)
    assert estimate(summary, "passes completed").value == approx(0.75)


def test_the_way_of_a_field_robot_is_the_mean_of_all() -> None:
    summary = summary_of([row(1, team(field_distance=1600.0), team(field_robots=2, field_distance=300.0))])
    assert estimate(summary, "m of a field robot in ten minutes").value == approx(400.0)
    assert estimate(summary, "m of a field robot in ten minutes", 1).value == approx(150.0)


def test_the_two_matches_of_a_seed_are_one_sample() -> None:
    pair = [row(1, team(4), team(), seed=1), row(2, team(0), team(), seed=1, swapped=True)]
    alone = estimate(summary_of(pair), "goals in ten minutes")
    assert (alone.value, alone.low) == (2.0, None)
    other = [row(3, team(3), team(), seed=2), row(4, team(3), team(), seed=2, swapped=True)]
    both = estimate(summary_of([*pair, *other]), "goals in ten minutes")
    assert (both.value, both.high) == (2.5, approx(2.5 + student_t(1) * 0.5))


def test_the_longest_times_are_given_with_their_match() -> None:
    rows = [row(1, team(), team(), longest_stuck_s=1.0), row(2, team(), team(), longest_stuck_s=4.0)]
    longest = {one.name: (one.seconds, one.row.seed) for one in summary_of(rows).longest}
    assert longest["longest time that a robot was stuck"] == (4.0, 2)


def test_the_row_of_a_match_has_the_times_of_its_figures() -> None:
    team = SimpleNamespace(goals=None, kicks=None, saves=None, fouls={}, cards={}, possession_s=None)
    robots = [SimpleNamespace(side=Side.CYAN, keeper=True, longest_stuck_s=seconds) for seconds in (2.0, 3.0)]
    times = {"in_play_s": 50.0, "crowded_s": 4.0, "longest_crowd_s": 1.5}
    figures: Any = SimpleNamespace(sides=dict.fromkeys(Side, team), robots=robots, **times)
    match: Any = SimpleNamespace(seed=1, swapped=False, sides=tuple(Side))
    made = row_of(1, match, Played("", figures, 60.0, "chain"))
    assert {name: getattr(made, name) for name in times} == times
    assert isinstance(made, MatchRow) and made.longest_stuck_s == 3.0


def test_a_series_of_which_nothing_was_played_has_no_figures() -> None:
    summary = summary_of([])
    assert summary.matches == 0
    assert named(summary.teams, "won").values == (0, 0)
    assert named(summary.teams, "goals in ten minutes").values == (None, None)
