"""How the host is doing, measured against wall time."""

from collections import deque

from schemas.clock import Clock
from schemas.host import Health
from sim_host.attendance import Attendance
from sim_host.inbox import Inbox

_EVERY_S = 0.25
"""Wall time between two reports."""
_OVER_S = 1.0
"""Wall time that the real-time factor is averaged over."""


class Pulse:
    """Real-time factor and tick times of the last second."""

    def __init__(self, clock: Clock, pace: str) -> None:
        self._clock = clock
        self._pace = pace
        self._marks: deque[tuple[float, float]] = deque()
        self._worst: deque[tuple[float, float]] = deque()
        self._last_tick = clock.now()
        self._next = 0.0

    def beat(self, time: float) -> bool:
        """A tick has ended at this simulated time, s; whether a report is due."""
        now = self._clock.now()
        self._worst.append((now, now - self._last_tick))
        self._last_tick = now
        if now < self._next:
            return False
        self._next = now + _EVERY_S
        self._marks.append((now, time))
        while now - self._marks[0][0] > _OVER_S and len(self._marks) > 2:
            self._marks.popleft()
        while self._worst and now - self._worst[0][0] > _OVER_S:
            self._worst.popleft()
        return True

    def report(self, tick: int, time: float, late: int, inbox: Inbox, attendance: Attendance) -> Health:
        """The report that is due."""
        (began, then), (now, until) = self._marks[0], self._marks[-1]
        return Health(
            tick=tick,
            time=time,
            pace=self._pace,
            real_time_factor=round((until - then) / (now - began), 3) if now > began else 0.0,
            late_ticks=late,
            worst_tick_ms=round(max((took for _, took in self._worst), default=0.0) * 1e3, 3),
            robots={name: ledger.health() for name, ledger in inbox.ledgers.items()},
            strangers=dict(inbox.strangers),
            recorders=attendance.behind(tick),
        )
