"""Formats the figures of a series for a terminal."""

from collections.abc import Sequence

from touchline.launch.terminal.aligned import counted
from touchline.matches.series.match_row import FailedMatch, MatchRow, Row
from touchline.matches.series.plan import SeriesPlan
from touchline.matches.series.summary import Figure, Longest, Value
from touchline.matches.statistics.estimates import Estimate

UNKNOWN = "–"
"""Stands for a figure without a sample, such as the share of completed passes without a pass."""

Cells = tuple[str, ...]


def sentence_of(row: Row, plan: SeriesPlan) -> str:
    """One match in one line, the first team first."""
    first, second = plan.teams
    head = f"seed {row.seed}{', sides swapped' if row.swapped else ''}: "
    if isinstance(row, FailedMatch):
        return f"{head}failed: {row.reason}"
    return f"{head}{first} {row.teams[0].goals} : {row.teams[1].goals} {second}"


def figure_rows(figures: Sequence[Figure]) -> list[Cells]:
    """One row for each figure: its name, and one cell for each value."""
    return [(one.name, *(_cell(value, percent=one.percent) for value in one.values)) for one in figures]


def headline(plan: SeriesPlan, played: Sequence[MatchRow], failed: Sequence[FailedMatch]) -> str:
    """The teams and the number of matches."""
    total, missing = len(plan.matches), len(plan.matches) - len(played) - len(failed)
    parts = [f"{len(played)} of {counted(total, 'match')}" if len(played) < total else counted(total, "match")]
    parts += [f"{len(failed)} failed"] if failed else []
    parts += [f"{missing} not played"] if missing else []
    return f"{plan.teams[0]} – {plan.teams[1]}   {', '.join(parts)}; in brackets: intervals of 95 %"


def longest_line(one: Longest) -> str:
    """A longest time, with the match that it was in."""
    swapped = ", sides swapped" if one.row.swapped else ""
    where = f" (seed {one.row.seed}{swapped})" if one.seconds > 0 else ""
    return f"{one.name}: {one.seconds:.1f} s{where}"


def _cell(value: Value, *, percent: bool) -> str:
    if value is None:
        return UNKNOWN
    if isinstance(value, int):
        return str(value)
    return _estimate(value.scaled(100) if percent else value, " %" if percent else "")


def _estimate(value: Estimate, unit: str) -> str:
    digits = 1 if unit else _digits(value.value)
    text = f"{value.value:.{digits}f}"
    if value.low is None or value.high is None:
        return f"{text}{unit}"
    return f"{text} ({value.low:.{digits}f} to {value.high:.{digits}f}){unit}"


def _digits(value: float) -> int:
    """Decimal places that keep three figures."""
    return 0 if value >= 100 else 1 if value >= 10 else 2
