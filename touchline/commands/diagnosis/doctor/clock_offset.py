"""How far the host's clock is from this machine's, from the stamps of its messages and the shortest round trip."""

from collections.abc import Iterable
from typing import NamedTuple

_PROCESSING_S = 5e-4
"""Longest wall time that the two programs add to the fastest message, in s."""


class ClockOffset(NamedTuple):
    """The host's clock minus this machine's."""

    seconds: float
    uncertainty: float
    """The true offset is at most this far from it, in s."""


def clock_offset(messages_ns: Iterable[tuple[int, int]], shortest_round_trip_s: float) -> ClockOffset | None:
    """The offset from messages, each with the host's time of sending and our time of arrival in ns; None without any.

    A message takes at least no time, and the fastest of them at most the shortest round trip and what the two programs
    add to it.
    """
    if (fastest := min((arrived - sent for sent, arrived in messages_ns), default=None)) is None:
        return None
    half = (shortest_round_trip_s + _PROCESSING_S) / 2
    return ClockOffset(half - fastest * 1e-9, half)
