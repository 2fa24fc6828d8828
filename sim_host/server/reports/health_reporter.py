"""Health of the host: its speed and tick times in wall time."""

from collections import deque

from runtime.process.clock import Clock
from schemas.messages.health import Health, TeamRadio
from schemas.side import Side
from sim_host.match.radio_use import RadioUse
from sim_host.server.admission.door import Admission, PresenceTracker
from sim_host.server.inbox import Inbox
from sim_host.timing import AVERAGING_S, HEALTH_S


class HealthReporter:
    """Real-time factor and tick times of the last second."""

    def __init__(self, clock: Clock, pace: str) -> None:
        self._clock = clock
        self._pace = pace
        self._marks: deque[tuple[float, float]] = deque()
        self._tick_times: deque[tuple[float, float]] = deque()
        """Wall time of the end of each tick of the last second, and how long the tick took, both in s."""
        self._last_tick = clock.now()
        self._next = 0.0

    def end_tick(self, time: float) -> bool:
        """Record the end of a tick at this simulated time in s; returns whether a report is due."""
        now = self._clock.now()
        self._tick_times.append((now, now - self._last_tick))
        self._last_tick = now
        if now < self._next:
            return False
        self._next = now + HEALTH_S
        self._marks.append((now, time))
        while now - self._marks[0][0] > AVERAGING_S and len(self._marks) > 2:
            self._marks.popleft()
        while self._tick_times and now - self._tick_times[0][0] > AVERAGING_S:
            self._tick_times.popleft()
        return True

    def report(
        self,
        tick: int,
        time: float,
        late: int,
        inbox: Inbox,
        presence: PresenceTracker,
        admission: Admission,
        radio: RadioUse,
        radio_budget: float,
    ) -> Health:
        """The report on the last second; `late` counts ticks that began late, `radio_budget` is a team's in bit/s."""
        marks = self._marks or [(0.0, 0.0)]
        (began, then), (now, until) = marks[0], marks[-1]
        return Health(
            tick=tick,
            time=time,
            pace=self._pace,
            real_time_factor=round((until - then) / (now - began), 3) if now > began else 0.0,
            late_ticks=late,
            worst_tick_ms=round(max((took for _, took in self._tick_times), default=0.0) * 1e3, 3),
            robots={name: stats.health(tick, radio.of_robot(name)) for name, stats in inbox.agent_stats.items()},
            strangers=dict(inbox.unknown_senders),
            recorders=presence.recorder_lags(tick),
            radio={side: TeamRadio(budget=radio_budget, busiest=radio.busiest(side)) for side in Side},
            accounts=admission.accounts.health(),
        )
