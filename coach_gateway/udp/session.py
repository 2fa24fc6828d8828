"""One coach program's session: which datagrams are new, came before or are late, and when it is over. Pure."""

from collections import OrderedDict
from dataclasses import dataclass, field
from enum import StrEnum

from coach_gateway.access.rate_limit import TokenBucket
from coach_gateway.access.roles import Role
from coach_gateway.udp.protocol import DEFAULT_RATE, Ack

SILENCE_S = 5.0
"""s of wall time without a datagram after which a session is over."""
KEPT = 64
"""Answers that are kept for datagrams that come again."""
PER_SECOND, AT_ONCE = 100.0, 200.0
"""Datagrams of one program that are read; what is more is left out."""


class SequenceStatus(StrEnum):
    """What a datagram's number says of it."""

    NEW = "new"
    UNANSWERED = "unanswered"
    """It came before and is being done: its answer will come."""
    ANSWERED = "answered"
    """It came before, and its answer may have been lost."""
    LATE = "late"
    """One with a larger number has been done: it no longer counts."""


@dataclass
class Session:
    """One program, from its hello to its end; times in s of wall time."""

    key: str
    role: Role
    name: str
    begun_at: float
    rate: float = DEFAULT_RATE
    rate_limit: TokenBucket = field(kw_only=True)
    """How much is read of this address, whatever sessions it begins."""
    heard_at: float = 0.0
    newest: int = 0
    """The largest number so far."""
    frames: int = 0
    due_at: float = 0.0
    """When the next frame is to be sent."""
    events_sent: int = 0
    hosts: int = 0
    """Which host's events these are: they are counted anew with each."""
    beliefs_sent: dict[str, float] = field(default_factory=dict)
    """Robot → simulated time of its word that was told last."""
    left_out: int = 0
    """Datagrams beyond what one program may say."""
    _answers: "OrderedDict[int, Ack | None]" = field(default_factory=OrderedDict)

    def __post_init__(self) -> None:
        self.heard_at = self.due_at = self.begun_at

    @property
    def waiting(self) -> int:
        """Datagrams that wait for their answers."""
        return sum(answer is None for answer in self._answers.values())

    def is_within_limit(self, now: float) -> bool:
        """Whether a datagram is read, rather than left out."""
        allowed = self.rate_limit.allow(now)
        self.left_out += not allowed
        return allowed

    def check(self, sequence: int) -> SequenceStatus:
        """What a number says; a new one is expected to be answered."""
        if sequence in self._answers:
            return SequenceStatus.UNANSWERED if self._answers[sequence] is None else SequenceStatus.ANSWERED
        if sequence <= self.newest:
            return SequenceStatus.LATE
        self.newest = sequence
        self._answers[sequence] = None
        while len(self._answers) > KEPT:
            self._answers.popitem(last=False)
        return SequenceStatus.NEW

    def answered(self, sequence: int, ack: Ack) -> None:
        """Keep an answer, in case the datagram comes again."""
        if sequence in self._answers:
            self._answers[sequence] = ack

    def answer(self, sequence: int) -> Ack | None:
        """The answer that was given."""
        return self._answers.get(sequence)

    def is_over(self, now: float) -> bool:
        """Nothing was heard of the program for too long."""
        return now - self.heard_at > SILENCE_S
