"""Statistics of one robot's agent: its answers, missed ticks and invalid messages."""

from collections import deque
from dataclasses import dataclass, field
from statistics import median

from schemas.messages.health import RobotHealth

SILENT_TICKS = 3
"""A robot that has missed this many ticks in a row is not waited for until it sends a valid message."""
LATENCY_SAMPLES = 50
"""Commands that the median latency is taken over: one second of ticks."""


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
    silent: int = 0
    """Ticks missed in a row."""
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

    @property
    def is_silent(self) -> bool:
        """Whether the host does not wait for it: it is idle, gone, or has missed several ticks in a row."""
        return self.idle or not self.alive or self.silent >= SILENT_TICKS

    @property
    def idle(self) -> bool:
        """Whether it has no robot to move."""
        return self.removed or self.still

    def end_tick(self, answered: bool) -> None:
        """Count a tick that ended with or without its command."""
        self.answering = answered
        if answered:
            self.silent = 0
        elif not self.idle:
            self.missed += 1
            self.silent += 1

    def mark_received(self) -> None:
        """Count a valid command, also a late one: an agent that was given up is waited for one tick more."""
        self.silent = min(self.silent, SILENT_TICKS - 1)

    def health(self) -> RobotHealth:
        """The statistics as they are published."""
        return RobotHealth(
            alive=self.alive,
            answering=self.answering,
            answers=self.answers,
            missed=self.missed,
            duplicates=self.duplicates,
            invalid=self.invalid,
            refused=self.refused,
            removed=self.removed,
            still=self.still,
            latency_ms=round(median(self.latencies) * 1e3, 3) if self.latencies else None,
        )
