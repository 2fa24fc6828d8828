"""Counts of latencies by size: small enough for every report, exact enough for quantiles within ten percent."""

import math
from collections.abc import Sequence

SHORTEST_S = 125e-6
"""Latencies below it, in s, are in the first class."""
PER_DOUBLING = 4
"""Classes in which the latency doubles: each class reaches to 2^¼ times the end of the one before."""
CLASSES = 62
"""Number of classes; the last one has all latencies above 4.1 s."""


def class_of(latency_s: float) -> int:
    """The class of a latency in s."""
    if latency_s < SHORTEST_S:
        return 0
    return min(CLASSES - 1, 1 + int(PER_DOUBLING * math.log2(latency_s / SHORTEST_S)))


def without_empty_end(counts: Sequence[int]) -> list[int]:
    """The counts up to the last that is not 0."""
    end = len(counts)
    while end and not counts[end - 1]:
        end -= 1
    return list(counts[:end])


def quantile_ms(counts: Sequence[int], share: float) -> float | None:
    """The latency in ms that this share of all latencies does not exceed; None without any."""
    rank, below = share * sum(counts), 0
    for number, count in enumerate(counts):
        if count and below + count >= rank:
            low, high = _end_ms(number - 1), _end_ms(number)
            return round(low + (high - low) * max(0.0, rank - below) / count, 3)
        below += count
    return None


def _end_ms(number: int) -> float:
    """The end of a class in ms; 0 before the first."""
    return SHORTEST_S * 1e3 * 2 ** (number / PER_DOUBLING) if number >= 0 else 0.0
