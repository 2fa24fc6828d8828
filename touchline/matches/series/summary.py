"""The figures of a series with their intervals: rows of a table, computed from the rows of its matches.

The two matches of a seed with sides swapped are one sample: they are not independent.
"""

import math
from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from touchline.matches.series.match_row import MatchRow, TeamRow
from touchline.matches.statistics.estimates import Estimate, ratio, share

TEN_MINUTES = 600.0
MINUTE = 60.0
SHARE = 1.0
"""Units of figures: a rate in so many s, or a share."""
Value = Estimate | int | None
Of = Callable[[MatchRow, TeamRow], float]


@dataclass(frozen=True, slots=True)
class Figure:
    """One row of the table."""

    name: str
    values: tuple[Value, ...]
    """One for each team, or one for the match."""
    percent: bool = False


@dataclass(frozen=True, slots=True)
class Longest:
    """The longest of all times of a kind, and where it was."""

    name: str
    seconds: float
    row: MatchRow


@dataclass(frozen=True, slots=True)
class Summary:
    """All figures of a series."""

    matches: int
    teams: list[Figure]
    sides: list[Figure]
    """Results by side in place of team: cyan's and magenta's."""
    match: list[Figure]
    longest: list[Longest]


def summary_of(rows: Sequence[MatchRow]) -> Summary:
    """The figures of these matches."""
    rows = sorted(rows, key=lambda row: row.number)
    return Summary(
        matches=len(rows),
        teams=[*_results(rows, lambda row: row.teams), *(_by_team(rows, *figure) for figure in _TEAM)],
        sides=_results(rows, _by_side),
        match=[_of_match(rows, *figure) for figure in _MATCH] if rows else [],
        longest=[Longest(name, max(map(of, rows)), max(rows, key=of)) for name, of in _LONGEST if rows],
    )


def _by_side(row: MatchRow) -> tuple[TeamRow, TeamRow]:
    first, second = row.teams
    return (second, first) if row.swapped else (first, second)


def _results(rows: Sequence[MatchRow], pair: Callable[[MatchRow], tuple[TeamRow, TeamRow]]) -> list[Figure]:
    leads = [pair(row)[0].goals - pair(row)[1].goals for row in rows]
    won, lost = sum(lead > 0 for lead in leads), sum(lead < 0 for lead in leads)
    drawn = len(leads) - won - lost
    return [
        Figure("won", (won, lost)),
        Figure("drawn", (drawn, drawn)),
        Figure("lost", (lost, won)),
        Figure(
            "share of points, draws half",
            (share(won + drawn / 2, len(leads)), share(lost + drawn / 2, len(leads))),
            percent=True,
        ),
        Figure("goals in ten minutes", tuple(_goals(rows, pair, which) for which in (0, 1))),
    ]


def _goals(
    rows: Sequence[MatchRow], pair: Callable[[MatchRow], tuple[TeamRow, TeamRow]], which: int
) -> Estimate | None:
    return _rate(rows, lambda row: pair(row)[which].goals, _playing, TEN_MINUTES)


def _rate(
    rows: Sequence[MatchRow], count: Callable[[MatchRow], float], size: Callable[[MatchRow], float], unit: float
) -> Estimate | None:
    """Counts by sizes; all matches of a seed are one sample."""
    counts: dict[int, float] = defaultdict(float)
    sizes: dict[int, float] = defaultdict(float)
    for row in rows:
        counts[row.seed] += count(row)
        sizes[row.seed] += size(row)
    found = ratio(list(counts.values()), list(sizes.values()), most=1.0 if unit == SHARE else math.inf)
    return found.scaled(unit) if found is not None else None


def _playing(row: MatchRow) -> float:
    return row.playing_time


def _by_team(rows: Sequence[MatchRow], name: str, count: Of, size: Of, unit: float) -> Figure:
    values = tuple(
        _rate(
            rows,
            lambda row, which=which: count(row, row.teams[which]),  # type: ignore[misc]
            lambda row, which=which: size(row, row.teams[which]),  # type: ignore[misc]
            unit,
        )
        for which in (0, 1)
    )
    return Figure(name, values, percent=unit == SHARE)


def _time(row: MatchRow, _: TeamRow) -> float:
    return row.playing_time


def _field_robots_time(row: MatchRow, team: TeamRow) -> float:
    return team.field_robots * row.playing_time


def _controlled_time(row: MatchRow, _: TeamRow) -> float:
    return sum(team.possession_s for team in row.teams)


def _of(field: str) -> Of:
    return lambda _, team: float(getattr(team, field))


_TEAM: tuple[tuple[str, Of, Of, float], ...] = (
    ("passes completed a minute", _of("passes_completed"), _time, MINUTE),
    ("passes completed", _of("passes_completed"), _of("passes"), SHARE),
    ("shots in ten minutes", _of("shots"), _time, TEN_MINUTES),
    ("shots on goal", _of("shots_on_goal"), _of("shots"), SHARE),
    ("saves in ten minutes", _of("saves"), _time, TEN_MINUTES),
    ("possession", _of("possession_s"), _controlled_time, SHARE),
    ("fouls a minute", _of("fouls"), _time, MINUTE),
    ("cards in ten minutes", _of("cards"), _time, TEN_MINUTES),
    ("m of a field robot in ten minutes", _of("field_distance"), _field_robots_time, TEN_MINUTES),
)
"""Name, what is counted, by what it is divided, and the unit."""


def _of_match(
    rows: Sequence[MatchRow],
    name: str,
    count: Callable[[MatchRow], float],
    size: Callable[[MatchRow], float],
    unit: float,
) -> Figure:
    return Figure(name, (_rate(rows, count, size, unit),), percent=unit == SHARE)


def _both(field: str) -> Callable[[MatchRow], float]:
    return lambda row: float(sum(getattr(team, field) for team in row.teams))


_MATCH: tuple[tuple[str, Callable[[MatchRow], float], Callable[[MatchRow], float], float], ...] = (
    ("goals of both in ten minutes", _both("goals"), _playing, TEN_MINUTES),
    ("passes of both completed a minute", _both("passes_completed"), _playing, MINUTE),
    ("passes of both completed", _both("passes_completed"), _both("passes"), SHARE),
    ("ball in play", lambda row: row.in_play_s, _playing, SHARE),
    ("fouls of both a minute", _both("fouls"), _playing, MINUTE),
    ("three or more robots within 1 m of the ball", lambda row: row.crowded_s, lambda row: row.in_play_s, SHARE),
)
_LONGEST: tuple[tuple[str, Callable[[MatchRow], float]], ...] = (
    ("longest time with three or more robots within 1 m of the ball", lambda row: row.longest_crowd_s),
    ("longest time that a robot was stuck", lambda row: row.longest_stuck_s),
)
