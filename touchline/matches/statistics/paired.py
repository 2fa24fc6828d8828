"""Means of seeds, paired differences and effect sizes, by scipy.

The unit is a seed: a seed's matches in a cell, one or both sides, are averaged first, because they share all random
numbers. Cells are compared seed by seed.
"""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace

import pandas as pd
from scipy import stats

from touchline.matches.statistics.estimates import LEVEL, Estimate, mean


@dataclass(frozen=True, slots=True)
class MeanEstimate(Estimate):
    """A mean over seeds, and its interval by Student's t; none with fewer than two seeds, or equal values in all."""

    seeds: int = 0


@dataclass(frozen=True, slots=True)
class Comparison:
    """A difference from a reference, seed by seed."""

    label: str
    """What is compared."""
    reference: str
    """What it is compared with."""
    estimate: MeanEstimate
    effect_size: float | None
    """Mean difference divided by the standard deviation of the seeds' differences (Cohen's d_z)."""
    p: float | None
    """Probability of a difference at least as large without any effect, by the paired t-test."""
    matches: int
    """Matches that were compared."""
    adjusted_p: float | None = None
    """p, adjusted for the number of comparisons; None before, and without a p."""

    @property
    def is_found(self) -> bool:
        """Whether there is a difference by the adjusted p, which few comparisons without an effect ever pass."""
        return self.adjusted_p is not None and self.adjusted_p < 1 - LEVEL


def estimate_of(values: "pd.Series[float]") -> MeanEstimate:
    """The mean of independent values with its interval."""
    values = values.dropna()
    found = mean([float(value) for value in values]) or Estimate(float("nan"))
    return MeanEstimate(found.value, found.low, found.high, len(values))


def seed_means(table: pd.DataFrame, response: str, matches: int) -> pd.DataFrame:
    """One row a seed, one column a cell: the mean of the `matches` of the seed in the cell.

    A seed of which a match is missing in a cell, or does not show the response, has no value in it.
    """
    groups = table.groupby(["seed", "cell"])[response]
    whole = groups.count() == matches
    return groups.mean().where(whole).unstack("cell")


def comparison_of(difference: "pd.Series[float]", label: str, reference: str, matches: int) -> Comparison:
    """The comparison of these differences, one of each seed, with 0; `matches` were played of each seed."""
    difference = difference.dropna()
    estimate = estimate_of(difference)
    if estimate.width is None:
        return Comparison(label, reference, estimate, None, None, matches * len(difference))
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)  # loss of precision would be hidden otherwise
        p = float(stats.ttest_1samp(difference, 0.0).pvalue)
    effect_size = float(difference.mean() / difference.std())
    return Comparison(label, reference, estimate, effect_size, p, matches * len(difference))


def adjusted(comparisons: Sequence[Comparison]) -> list[Comparison]:
    """The comparisons with their p-values adjusted for their number by Benjamini and Hochberg's procedure."""
    known = [one.p for one in comparisons if one.p is not None]
    each = iter(stats.false_discovery_control(known).tolist() if known else [])
    return [one if one.p is None else replace(one, adjusted_p=next(each)) for one in comparisons]


def widest(table: pd.DataFrame, response: str, matches: int) -> float | None:
    """Width of the widest interval of a response: of the differences, or of the mean of the only cell.

    None if one of them has no interval.
    """
    if table.empty or response not in table:
        return None
    means = seed_means(table, response, matches)
    first, *others = means.columns
    compared = [means[cell] - means[first] for cell in others] or [means[first]]
    estimates = [estimate_of(values) for values in compared]
    widths = [one.width for one in estimates if one.width is not None]
    return max(widths) if len(widths) == len(estimates) else None
