"""Counts of latencies by size: small enough for every report, exact enough for quantiles within ten percent."""

from bisect import bisect_right
from collections.abc import Sequence

SHORTEST_S = 125e-6
"""Latencies below it, in s, are in the first class."""
PER_DOUBLING = 4
"""Classes in which the latency doubles: each class reaches to 2^¼ times the end of the one before."""
CLASSES = 62
"""Number of classes; the last one has all latencies above 4.1 s."""
_ENDS = [SHORTEST_S * 2 ** (number / PER_DOUBLING) for number in range(CLASSES - 1)]
"""End of each class but the last, in s."""


def class_of(latency_s: float) -> int:
    """The class of a latency in s."""
    return bisect_right(_ENDS, latency_s)


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
            low, high = 1e3 * _ENDS[number - 1] if number else 0.0, 1e3 * _ENDS[min(number, CLASSES - 2)]
            return round(low + (high - low) * max(0.0, rank - below) / count, 3)
        below += count
    return None
