"""Keeps the messages of a key in their order until what is missing has come, or is known to be gone for good.

Zenoh asks a writer's cache for what a reader missed, and goes on without it as soon as that question ends: also when
the link broke in the middle of the answer, or when more was dropped while it came. What it leaves missing is asked for
here again. Knows no network: `zenoh_mending` asks the questions.
"""

import math
from collections import deque
from collections.abc import Iterable
from typing import NamedTuple

from schemas.bus.contract import Received, Stamp

ASK_AGAIN_S = 0.2
"""Wall time between an answer that was cut off and the next question."""
GIVE_UP_S = 20.0
"""Wall time after which what is missing is waited for no more: longer than any link takes that comes back."""
REACH = 100
"""Messages of a key that are asked for before the first that came: as many as go missing while a link is busy."""


class Gap(NamedTuple):
    """What is to be asked for: of one writer's messages on one key, those from `first` to `last`, both included.

    The last of them has come already: an answer in which it stands was not cut off.
    """

    key: str
    writer: str
    first: int
    last: int


class _Line:
    """One writer's messages on one key."""

    __slots__ = ("ask_at", "asking", "expected", "give_up_at", "held", "writer")

    def __init__(self, writer: str, expected: int) -> None:
        self.writer = writer
        self.expected = expected
        self.held: dict[int, Received] = {}
        self.asking = False
        self.ask_at = self.give_up_at = 0.0

    @property
    def due_at(self) -> float:
        """When it is asked for, or given up."""
        return self.give_up_at if self.asking else min(self.ask_at, self.give_up_at)


class Mender:
    """Puts messages into the order of their numbers; times are wall time in s."""

    def __init__(self, since_ns: int, reach: int = REACH) -> None:
        """Before the first message of a key that comes, up to `reach` others are asked for: nobody could see a gap
        there. Of these, what was sent before `since_ns` (wall time) is not wanted.
        """
        self._since_ns, self._reach = since_ns, reach
        self.ready: deque[Received] = deque()
        """What is in order, to be taken from the left."""
        self._lines: dict[str, _Line] = {}
        self._broken: dict[str, _Line] = {}
        """The lines with a gap."""

    def passes(self, received: Received) -> bool:
        """Whether a message that has come is the next of its key, and nothing is held back: most are."""
        stamp, line = received.stamp, self._lines.get(received.key)
        if line is None or stamp is None or stamp.sequence != line.expected or line.held:
            return False
        line.expected += 1
        return True

    def take(self, received: Received, writer: str | None, now: float) -> None:
        """A message has come that does not pass, of this writer; nobody can be asked where that is not known."""
        stamp, key = received.stamp, received.key
        line = self._lines.get(key)
        if stamp is None or writer is None:
            self.ready.append(received)
        else:
            if line is None or line.writer != writer:
                self._skip_all(key)
                line = self._lines[key] = _Line(writer, self._first_of(stamp))
            if stamp.sequence < line.expected:
                self.ready.append(received)  # a double; who keeps account will see it
                return
            if not line.held:
                line.ask_at, line.give_up_at = now, now + GIVE_UP_S
                self._broken[key] = line
            line.held[stamp.sequence] = received
            self._advance(key, line)

    @property
    def is_broken(self) -> bool:
        """Whether something is missing."""
        return bool(self._broken)

    def due_at(self) -> float:
        """When there is something to ask for, or to give up; infinite while nothing is missing."""
        return min((line.due_at for line in self._broken.values()), default=math.inf)

    def questions(self, now: float) -> list[Gap]:
        """What is to be asked for now; each is answered by `answered`."""
        gaps = []
        for key, line in list(self._broken.items()):
            if now >= line.give_up_at:
                self._skip(key, line)
                line.give_up_at = now + GIVE_UP_S
            elif not line.asking and now >= line.ask_at:
                line.asking = True
                gaps.append(Gap(key, line.writer, line.expected, min(line.held)))
        return gaps

    def answered(self, gap: Gap, found: Iterable[Received], now: float) -> None:
        """The answer to a question has ended, whole or cut off."""
        line = self._lines.get(gap.key)
        if line is None or line.writer != gap.writer:
            return
        line.asking, line.ask_at = False, now + ASK_AGAIN_S
        expected, whole = line.expected, False
        for received in found:
            if received.stamp is not None:
                number = received.stamp.sequence
                whole = whole or number == gap.last
                if self._is_wanted(received.stamp, line):
                    line.held.setdefault(number, received)
        self._advance(gap.key, line)
        if whole and line.expected < gap.last:
            self._skip(gap.key, line)  # the writer keeps it no more, or nobody wants it
        if line.expected > expected:
            line.give_up_at = now + GIVE_UP_S

    def forgo(self) -> None:
        """Wait for nothing that is missing."""
        for key in list(self._broken):
            self._skip_all(key)

    def _first_of(self, stamp: Stamp) -> int:
        """The number to begin a key with whose first message that came has this stamp."""
        return max(0, stamp.sequence - self._reach) if stamp.sent_ns >= self._since_ns else stamp.sequence

    def _is_wanted(self, stamp: Stamp, line: _Line) -> bool:
        return stamp.sequence >= line.expected and stamp.sent_ns >= self._since_ns

    def _skip_all(self, key: str) -> None:
        while (line := self._broken.get(key)) is not None:
            self._skip(key, line)

    def _skip(self, key: str, line: _Line) -> None:
        """Go on behind a gap."""
        line.expected = min(line.held)
        self._advance(key, line)

    def _advance(self, key: str, line: _Line) -> None:
        held = line.held
        while (received := held.pop(line.expected, None)) is not None:
            line.expected += 1
            self.ready.append(received)
        if not held:
            self._broken.pop(key, None)
