"""Checks that the host's messages of a segment are in order, each once, and have the log time of their tick."""

from typing import NamedTuple

from recordings.reading.recording import RecordedMessage
from schemas.topics import APPLIED, STATE, WORLD

_ONCE_A_TICK = frozenset({APPLIED.key, WORLD.key, STATE.key})
"""Keys with at most one message in each tick."""


class OrderFault(NamedTuple):
    """A message that is not where its tick belongs."""

    tick: int
    """Tick of the segment at which it was found."""
    key: str
    why: str


class RecordOrder:
    """Follows the messages of the host, in the order of the file."""

    def __init__(self, ticks: range, tick_s: float) -> None:
        """`ticks` are the segment's: messages of other ticks are faults only at log times of the segment."""
        self._ticks = ticks
        self._tick_s = tick_s
        self._last: dict[str, int] = {}
        self._faults: list[OrderFault] = []

    def add(self, recorded: RecordedMessage, tick: int) -> None:
        """Add a message of the host with the tick that its payload names."""
        key = recorded.key
        if recorded.log_ns != round(tick * self._tick_s * 1e9):
            self._add_fault(recorded, tick, f"its log time is {recorded.time:.9g} s, that of tick {tick} is another")
        before = self._last.get(key, -1)
        if tick < before:
            self._add_fault(recorded, tick, f"tick {tick} comes after tick {before}")
        elif tick == before and key in _ONCE_A_TICK:
            self._add_fault(recorded, tick, f"there are two messages of tick {tick}")
        self._last[key] = max(tick, before)

    def add_unreadable(self, recorded: RecordedMessage) -> None:
        """Add a message without a tick."""
        self._add_fault(recorded, self._tick_at(recorded), "a payload names no tick")

    def fault_until(self, tick: int) -> OrderFault | None:
        """The first fault at this tick or before it."""
        return min((fault for fault in self._faults if fault.tick <= tick), default=None)

    def _add_fault(self, recorded: RecordedMessage, tick: int, why: str) -> None:
        found = [one for one in (tick, self._tick_at(recorded)) if one in self._ticks]
        if found:
            self._faults.append(OrderFault(min(found), recorded.key, why))

    def _tick_at(self, recorded: RecordedMessage) -> int:
        """The tick at the log time of a message."""
        return round(recorded.log_ns / 1e9 / self._tick_s)
