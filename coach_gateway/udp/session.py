"""One coach program's session: which datagrams are new, repeated or late, and when the session is over. Pure."""

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from coach_gateway.access.roles import TokenRole
from coach_gateway.timing import SILENCE_S
from coach_gateway.udp.protocol import DEFAULT_RATE, Ack

KEPT = 64
"""Acknowledgements that are kept for repeated datagrams."""

Address = tuple[Any, ...]
"""Host and port of a program."""


class SequenceStatus(StrEnum):
    """What follows from a datagram's number."""

    NEW = "new"
    UNANSWERED = "unanswered"
    """It came before and is in progress: its acknowledgement will come."""
    ANSWERED = "answered"
    """It came before, and its acknowledgement may have been lost."""
    LATE = "late"
    """A datagram with a larger number was received first: this one does not count."""


@dataclass
class Session:
    """One program, from its hello to its end; times in s of wall time."""

    key: str
    role: TokenRole
    name: str
    begun_at: float
    rate: float = DEFAULT_RATE
    heard_at: float = 0.0
    newest: int = 0
    """The largest number so far."""
    frames: int = 0
    due_at: float = 0.0
    """Wall time of the next frame."""
    events_sent: int = 0
    host_changes: int = 0
    """Number of the host whose events these are: they are counted anew with each."""
    beliefs_sent: dict[str, float] = field(default_factory=dict)
    """Robot → simulated time of its belief that was sent last."""
    _answers: dict[int, Ack | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.heard_at = self.due_at = self.begun_at

    @property
    def waiting(self) -> int:
        """Datagrams that wait for their acknowledgements."""
        return sum(answer is None for answer in self._answers.values())

    def check(self, sequence: int) -> SequenceStatus:
        """What follows from a number; a new one is noted as waiting for its acknowledgement."""
        if sequence in self._answers:
            return SequenceStatus.UNANSWERED if self._answers[sequence] is None else SequenceStatus.ANSWERED
        if sequence <= self.newest:
            return SequenceStatus.LATE
        self.newest = sequence
        self._answers[sequence] = None
        while len(self._answers) > KEPT:
            del self._answers[next(iter(self._answers))]
        return SequenceStatus.NEW

    def answered(self, sequence: int, ack: Ack) -> None:
        """Keep an acknowledgement, in case the datagram comes again."""
        if sequence in self._answers:
            self._answers[sequence] = ack

    def answer(self, sequence: int) -> Ack | None:
        """The acknowledgement of a datagram; None where there is none yet."""
        return self._answers.get(sequence)

    def is_over(self, now: float) -> bool:
        """Whether nothing was received for longer than `SILENCE_S`."""
        return now - self.heard_at > SILENCE_S
