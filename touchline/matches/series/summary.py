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
Teams = Sequence[TeamRow]
Choice = Callable[[MatchRow], Teams]
"""The teams of a match that a value is about: one of them, or both."""
Of = Callable[[MatchRow, Teams], float]


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
    each: list[Choice] = [lambda row: row.teams[:1], lambda row: row.teams[1:]]
    sides: list[Choice] = [lambda row: _by_side(row)[:1], lambda row: _by_side(row)[1:]]
    both: list[Choice] = [lambda row: row.teams]
    return Summary(
        matches=len(rows),
        teams=[*_results(rows, each), *(_figure(rows, each, *figure) for figure in _TEAM)],
        sides=_results(rows, sides),
        match=[_figure(rows, both, *figure) for figure in _MATCH] if rows else [],
        longest=[Longest(name, max(map(of, rows)), max(rows, key=of)) for name, of in _LONGEST if rows],
    )


def _by_side(row: MatchRow) -> Teams:
    return row.teams[::-1] if row.swapped else row.teams


def _results(rows: Sequence[MatchRow], choices: Sequence[Choice]) -> list[Figure]:
    """What two teams have won and scored."""
    first, second = choices
    leads = [first(row)[0].goals - second(row)[0].goals for row in rows]
    won, lost = sum(lead > 0 for lead in leads), sum(lead < 0 for lead in leads)
    drawn = len(leads) - won - lost
    points = (share(won + drawn / 2, len(leads)), share(lost + drawn / 2, len(leads)))
    return [
        Figure("won", (won, lost)),
        Figure("drawn", (drawn, drawn)),
        Figure("lost", (lost, won)),
        Figure("share of points, draws half", points, percent=True),
        _figure(rows, choices, "goals in ten minutes", _of("goals"), _time, TEN_MINUTES),
    ]


def _figure(rows: Sequence[MatchRow], choices: Sequence[Choice], name: str, count: Of, size: Of, unit: float) -> Figure:
    return Figure(name, tuple(_rate(rows, one, count, size, unit) for one in choices), percent=unit == SHARE)


def _rate(rows: Sequence[MatchRow], teams: Choice, count: Of, size: Of, unit: float) -> Estimate | None:
    """Counts by sizes; all matches of a seed are one sample."""
    counts: dict[int, float] = defaultdict(float)
    sizes: dict[int, float] = defaultdict(float)
    for row in rows:
        counts[row.seed] += count(row, teams(row))
        sizes[row.seed] += size(row, teams(row))
    found = ratio(list(counts.values()), list(sizes.values()), most=1.0 if unit == SHARE else math.inf)
    return found.scaled(unit) if found is not None else None


def _of(field: str) -> Of:
    return lambda _, teams: float(sum(getattr(team, field) for team in teams))


def _time(row: MatchRow, _: Teams) -> float:
    return row.playing_time


def _field_robots_time(row: MatchRow, teams: Teams) -> float:
    return sum(team.field_robots for team in teams) * row.playing_time


_TEAM: tuple[tuple[str, Of, Of, float], ...] = (
    ("passes completed a minute", _of("passes_completed"), _time, MINUTE),
    ("passes completed", _of("passes_completed"), _of("passes"), SHARE),
    ("shots in ten minutes", _of("shots"), _time, TEN_MINUTES),
    ("shots on goal", _of("shots_on_goal"), _of("shots"), SHARE),
    ("saves in ten minutes", _of("saves"), _time, TEN_MINUTES),
    ("possession", _of("possession_s"), lambda row, _: sum(team.possession_s for team in row.teams), SHARE),
    ("fouls a minute", _of("fouls"), _time, MINUTE),
    ("cards in ten minutes", _of("cards"), _time, TEN_MINUTES),
    ("m of a field robot in ten minutes", _of("field_distance"), _field_robots_time, TEN_MINUTES),
)
"""Figures of each team: name, what is counted, by what it is divided, and the unit."""
_MATCH: tuple[tuple[str, Of, Of, float], ...] = (
    ("goals of both in ten minutes", _of("goals"), _time, TEN_MINUTES),
    ("passes of both completed a minute", _of("passes_completed"), _time, MINUTE),
    ("passes of both completed", _of("passes_completed"), _of("passes"), SHARE),
    ("ball in play", lambda row, _: row.in_play_s, _time, SHARE),
    ("fouls of both a minute", _of("fouls"), _time, MINUTE),
    ("three or more robots within 1 m of the ball", lambda row, _: row.crowded_s, lambda row, _: row.in_play_s, SHARE),
)
"""Figures of both teams together."""
_LONGEST: tuple[tuple[str, Callable[[MatchRow], float]], ...] = (
    ("longest time with three or more robots within 1 m of the ball", lambda row: row.longest_crowd_s),
    ("longest time that a robot was stuck", lambda row: row.longest_stuck_s),
)
