"""Statistics of one robot's agent: its answers, missed ticks and invalid messages."""

from collections import deque
from dataclasses import dataclass, field
from statistics import median

from schemas.messages.health import MAX_FAULT, RobotHealth
from schemas.messages.latency_counts import CLASSES, class_of, without_empty_end
from sim_host.match.radio_use import NO_RADIO, RobotRadio
from sim_host.timing import QUICK_S

SILENT_TICKS = 3
"""A robot that has missed this many ticks in a row is not waited for until it sends a valid message."""
MOST_TICKS_GIVEN_UP = 250
"""A robot that answers, but always too late, is waited for again after at most this many ticks."""
LATENCY_SAMPLES = 50
"""Commands that the median latency is taken over: one second of ticks."""
_REPEATED_COMMANDS = 100
"""Most commands that an agent sends in addition to one for each tick: a larger gap is another agent's numbering."""
_PUBLISHED = (
    *("alive", "answering", "removed", "still", "answers", "missed", "missed_in_a_row", "duplicates", "invalid"),
    *("refused", "sights", "unanswered", "late", "lost_commands"),
)
"""Fields of an agent's statistics that are published as they are."""


@dataclass(slots=True)
class AgentStats:
    """Counts of what one agent answered, missed, sent twice, or sent invalid."""

    alive: bool = False
    is_admitted: bool = True
    """Its commands are accepted."""
    answering: bool = False
    answers: int = 0
    missed: int = 0
    duplicates: int = 0
    invalid: int = 0
    refused: int = 0
    sights: int = 0
    unanswered: int = 0
    late: int = 0
    lost_commands: int = 0
    silent: int = 0
    """Ticks missed in a row, for which the host waits for the agent; late answers lower it."""
    missed_in_a_row: int = 0
    next_chance: int = 0
    """Ticks missed in a row after which a late answer is a reason to wait for the agent again."""
    invalid_reason: str = ""
    """What was wrong with its newest message; empty after a valid one."""
    late_answer: int | None = None
    """The earlier tick that its newest message answers; None after an answer to the newest sight."""
    is_over_limit: bool = False
    """Its newest message was not read: its account is over its limit."""
    removed: bool = False
    """Its robot was taken off the pitch."""
    still: bool = False
    """Its robot stands still, whatever the agent sends."""
    newest: int = -1
    """Tick of the newest sight it has answered."""
    acknowledged: int | None = None
    """Number of the coach's order that its newest command acknowledges."""
    refused_order: str = ""
    """Why it does not carry out that order; empty where it does."""
    latencies: deque[float] = field(default_factory=lambda: deque(maxlen=LATENCY_SAMPLES))
    latency_counts: list[int] = field(default_factory=lambda: [0] * CLASSES)
    """All latencies since the match began, by class."""
    _ticks_without_sight: int = 0
    """Ticks since its newest answer in which no sight was sent to it."""
    next_sequence: int = -1
    """Sequence number of its next message; -1 before the first."""

    @property
    def is_silent(self) -> bool:
        """Whether the host does not wait for it: idle, gone, over its limit, or several ticks missed in a row."""
        return self.idle or not self.alive or self.is_over_limit or self.silent >= SILENT_TICKS

    @property
    def idle(self) -> bool:
        """Whether it has no robot to move."""
        return self.removed or self.still

    def end_tick(self, answered: bool) -> None:
        """Count a tick that ended with or without its command."""
        self.answering = answered
        if answered or (self.alive and not self.removed):
            self.sights += 1
        else:
            self._ticks_without_sight += 1
        if answered:
            self.silent = self.missed_in_a_row = self.next_chance = 0
        elif not self.idle:
            self.missed += 1
            self.missed_in_a_row += 1
            self.silent += 1

    def add_gap(self, sequence: int, tick: int) -> None:
        """Count the messages that are missing before this sequence number, which is above the next, at `tick`.

        A gap that is longer than an agent can make is one of another agent.
        """
        gap = sequence - self.next_sequence
        if self.next_sequence >= 0 and gap <= tick - self.newest + _REPEATED_COMMANDS:
            self.lost_commands += gap

    def add_latency(self, latency_s: float) -> None:
        """Add the wall time in s from a sight to its command."""
        self.latencies.append(latency_s)
        self.latency_counts[class_of(latency_s)] += 1

    def add_invalid(self, reason: str) -> None:
        """Count a message that is not a valid command."""
        self.invalid += 1
        self.invalid_reason = reason

    def add_answer(self, answered: int, tick: int) -> bool:
        """Count a valid command at this tick, which answers the tick `answered`; returns whether it is no repetition.

        An agent that was given up is waited for one tick more. If it is late again, that chance comes less often.
        """
        self.invalid_reason = ""
        self.late_answer = answered if answered < tick else None
        if answered <= self.newest:
            self.duplicates += 1
            return False
        if answered != self.newest + 1:
            self.unanswered += max(0, answered - self.newest - 1 - self._ticks_without_sight)
            self._ticks_without_sight = 0
        self.newest = answered
        self.answers += 1
        if answered < tick:
            self.late += 1
        if self.silent >= SILENT_TICKS and self.missed_in_a_row >= self.next_chance:
            self.next_chance = self.missed_in_a_row + min(self.missed_in_a_row, MOST_TICKS_GIVEN_UP)
            self.silent = SILENT_TICKS - 1
        return True

    def fault(self, tick: int) -> str:
        """Why the messages of an agent that does not answer are no answers at this tick; empty if it sends none."""
        if self.invalid_reason:
            return self.invalid_reason
        if self.late_answer is None or self.latency_s >= QUICK_S:
            return ""
        return f"answers tick {self.late_answer}, the match is at {tick}; use sight.tick"

    @property
    def latency_s(self) -> float:
        """Median wall time from sight to command; 0 without an answer."""
        return median(self.latencies) if self.latencies else 0.0

    def health(self, tick: int, radio: RobotRadio = NO_RADIO) -> RobotHealth:
        """The statistics as they are published at this tick, with the use of its robot's radio."""
        return RobotHealth(
            **{name: getattr(self, name) for name in _PUBLISHED},
            latency_ms=round(self.latency_s * 1e3, 3) if self.latencies else None,
            radio_bytes=radio.bytes,
            radio_refused=radio.refused,
            latencies=without_empty_end(self.latency_counts),
            fault="" if self.answering or self.idle else self.fault(tick)[:MAX_FAULT],
        )
