"""Compares two studies cell by cell: for one idea before and after a change of the code."""

from dataclasses import dataclass

import pandas as pd
from scipy import stats

from schemas.errors import TouchlineError
from touchline.matches.statistics.estimates import LEVEL
from touchline.matches.statistics.paired import Comparison, MeanEstimate, comparison_of, seed_means
from touchline.matches.study.study_folder import StoredStudy


@dataclass(frozen=True, slots=True)
class CellComparison:
    """One response in a cell that both studies have."""

    response: str
    cell: str
    comparison: Comparison
    """The second study's value less the first's."""
    paired: bool
    """Whether seeds were compared one by one; otherwise the two samples are taken for independent (Welch)."""


def compare_studies(one: StoredStudy, other: StoredStudy) -> list[CellComparison]:
    """The responses that both studies report, in each cell with the same levels.

    Raises:
        TouchlineError: the studies have no cell, or no response, in common.
    """
    names = {cell.label: number for number, cell in enumerate(other.plan.cells, start=1)}
    shared = {
        number: (cell.label, names[cell.label])
        for number, cell in enumerate(one.plan.cells, start=1)
        if cell.label in names
    }
    if not shared:
        raise TouchlineError(
            f"{one.folder} and {other.folder} have no cell with the same levels; compare like with like"
        )
    responses = [name for name in one.plan.study.responses if name in one.table and name in other.table]
    if not responses:
        raise TouchlineError(f"{one.folder} and {other.folder} have no response in common")
    found = []
    for response in responses:
        first = seed_means(one.table, response, one.plan.study)
        second = seed_means(other.table, response, other.plan.study)
        for number, (label, its) in shared.items():
            if number in first and its in second:
                compared, paired = _compared(first[number].dropna(), second[its].dropna(), one, other)
                found.append(CellComparison(response, label, compared, paired))
    return found


def _compared(
    first: "pd.Series[float]", second: "pd.Series[float]", one: StoredStudy, other: StoredStudy
) -> tuple[Comparison, bool]:
    names = str(other.folder), str(one.folder)
    sides = [2 if study.plan.study.both_sides else 1 for study in (one, other)]
    common = first.index.intersection(second.index)
    if len(common) >= 2 or min(len(first), len(second)) < 2:
        return comparison_of(second[common] - first[common], *names, sum(sides)), True
    test = stats.ttest_ind(second, first, equal_var=False)
    interval = test.confidence_interval(LEVEL)
    value = float(second.mean() - first.mean())
    estimate = MeanEstimate(value, float(interval.low), float(interval.high), len(first) + len(second))
    matches = len(first) * sides[0] + len(second) * sides[1]
    spread = float(((first.var() + second.var()) / 2) ** 0.5)
    return Comparison(*names, estimate, value / spread if spread else None, float(test.pvalue), matches), False
