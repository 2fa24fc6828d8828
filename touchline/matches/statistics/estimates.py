"""Estimates with intervals of 95 %: shares by Wilson's score, rates and means by Student's t."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from scipy import special

LEVEL = 0.95
"""Share of intervals that contain the true value."""
_Z = float(special.ndtri((1 + LEVEL) / 2))
_ROUNDING = 1e-12
"""Share of all counts, or of a value, up to which a deviation is one of rounding."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """A value and its interval; without an interval, `low` and `high` are None: there are too few samples."""

    value: float
    low: float | None = None
    high: float | None = None

    @property
    def width(self) -> float | None:
        """`high` less `low`."""
        return None if self.low is None or self.high is None else self.high - self.low

    @property
    def contains_zero(self) -> bool | None:
        """Whether 0 is in the interval; None without an interval."""
        return None if self.low is None or self.high is None else self.low <= 0 <= self.high

    def scaled(self, factor: float) -> "Estimate":
        """The same in another unit."""
        low, high = (None if one is None else one * factor for one in (self.low, self.high))
        return Estimate(self.value * factor, low, high)


def share(successes: float, trials: int) -> Estimate | None:
    """The share of successes with Wilson's score interval; None without a trial.

    Half successes, such as draws, are allowed: scipy has this interval for whole numbers only.
    """
    if trials == 0:
        return None
    p, z2 = successes / trials, _Z * _Z
    middle = (p + z2 / (2 * trials)) / (1 + z2 / trials)
    half = _Z / (1 + z2 / trials) * math.sqrt(p * (1 - p) / trials + z2 / (4 * trials * trials))
    return Estimate(p, max(0.0, middle - half), min(1.0, middle + half))


def ratio(counts: Sequence[float], sizes: Sequence[float], most: float = math.inf) -> Estimate | None:
    """Sum of the counts, none below 0, by sum of the sizes, for example goals by minutes, over independent samples.

    The interval is the ratio estimator's: the samples' deviations from the common ratio, and Student's t; none for
    fewer than two samples, or equal ratios. `most` is the greatest possible value, 1 for a share. None if the sizes add
    up to 0.
    """
    size, number = sum(sizes), len(sizes)
    if size <= 0:
        return None
    value = sum(counts) / size
    deviations = [count - value * one for count, one in zip(counts, sizes, strict=True)]
    if number < 2 or max(map(abs, deviations)) <= _ROUNDING * sum(counts):
        return Estimate(value)
    error = math.sqrt(sum(one**2 for one in deviations) * number / (number - 1)) / size
    half = student_t(number - 1) * error
    return Estimate(value, max(0.0, value - half), min(most, value + half))


def mean(values: Sequence[float]) -> Estimate | None:
    """The mean of independent samples with its interval by Student's t; none for fewer than two, or equal ones.

    None without a sample.
    """
    number = len(values)
    if number == 0:
        return None
    value = math.fsum(values) / number
    squares = math.fsum((one - value) ** 2 for one in values)
    if max(values) - min(values) <= _ROUNDING * max(map(abs, values)):
        return Estimate(value)
    half = student_t(number - 1) * math.sqrt(squares / (number - 1) / number)
    return Estimate(value, value - half, value + half)


def student_t(freedom: int) -> float:
    """The quantile of Student's t within which `LEVEL` of its values lie, on both sides of 0."""
    return float(special.stdtrit(freedom, (1 + LEVEL) / 2))
