"""The player publishes recorded messages when they are due, and implements the controls of a replay.

At any rate, messages are published in recorded order. The player uses neither bus nor files: it is given a cursor to
read from and a function that publishes.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from recordings.replay.playback_clock import AS_FAST_AS_POSSIBLE, PlaybackClock
from recordings.timing import POLL_S
from runtime.process.clock import Clock
from schemas.errors import TouchlineError
from schemas.messages.replay import ReplayOperation, ReplayReply, ReplayRequest, ReplayTopic
from schemas.messages.soccer.game import GameEvent
from schemas.topic import Topic
from schemas.topics import ACTIVE_ORDER, APPLIED, BELIEF, COMMAND, DEBUG, HEALTH, ORDER, SIGHT, STATE, WORLD

LATCHED_TOPICS = frozenset(
    topic.key for topic in (WORLD, STATE, APPLIED, HEALTH, COMMAND, SIGHT, BELIEF, DEBUG, ORDER, ACTIVE_ORDER)
)
"""Topics whose newest message is the current state; all but events and reports of invalid messages."""
_MAX_AT_ONCE = 500
"""Maximum number of messages between two checks of the controls."""


@dataclass(frozen=True, slots=True)
class PlaybackRange:
    """The part of a recording that is played; simulated time in ns."""

    start_ns: int
    end_ns: int | None = None
    """End of the range, inclusive; None for the end of the recording."""


def is_latched(topic: Topic) -> bool:
    """Whether the newest message of this topic is the current state."""
    return topic.key in LATCHED_TOPICS


class Playable(Protocol):
    """A message that can be played."""

    @property
    def key(self) -> str: ...
    @property
    def topic(self) -> Any: ...
    @property
    def log_ns(self) -> int: ...


class Source(Protocol):
    """What messages are read from: `Cursor` for the recording of a match, `LogCursor` for any MCAP file."""

    @property
    def start_ns(self) -> int: ...
    @property
    def end_ns(self) -> int: ...
    @property
    def finished(self) -> bool: ...
    def grow(self) -> bool: ...
    def peek(self) -> Any: ...
    def skip(self) -> None: ...
    def seek(self, ns: int) -> None: ...
    def latched(self, ns: int, is_latched: Callable[[Any], bool]) -> list[Any]: ...


class Player:
    """Plays the messages that a cursor reads."""

    def __init__(
        self,
        cursor: Source,
        clock: Clock,
        publish: Callable[[Any], None],
        span: PlaybackRange | None = None,
        *,
        rate: float = 1.0,
        paused: bool = False,
        loop: bool = False,
        stay: bool = False,
        follow: bool = False,
        time_of: Callable[[str], float] = float,
        events: Callable[[], list[GameEvent]] = list,
        topics: Sequence[ReplayTopic] = (),
        can_publish: Callable[[], bool] = lambda: True,
    ) -> None:
        """Start at the beginning of `span`.

        `stay` pauses at the end instead of ending; `follow` waits there for data that a recorder adds. `time_of`
        converts a seek target to simulated time in s, `events` returns all events of the recording; any other file has
        `topics`. A new tick is published only when `can_publish` allows it.
        """
        self._cursor, self._clock, self._publish = cursor, clock, publish
        self._span = span or PlaybackRange(cursor.start_ns)
        self._stay, self._follow, self._loop = stay, follow, loop
        self._time_of, self._events, self._can_publish = time_of, events, can_publish
        self._topics = topics
        self._latched: dict[str, Playable] = {}
        self._playback = PlaybackClock(self._span.start_ns, clock.now(), rate, paused)
        self._position_ns = self._span.start_ns
        self._open_ns: int | None = None
        self._steps = 0
        self._checked_at = -math.inf
        self.published = 0
        """Messages published so far."""
        self._has_begun = self._is_at_start = False
        self.ended = False
        """Whether the replay has ended."""
        self._seek_to(self._span.start_ns)

    @property
    def position_ns(self) -> int:
        """Current position, in ns of simulated time."""
        if self.paused or math.isinf(self._playback.rate):
            return self._position_ns
        message = self._next()
        ahead = message.log_ns if message is not None else self._position_ns
        return max(self._position_ns, min(round(self._playback.due_ns(self._clock.now())), ahead))

    @property
    def end_ns(self) -> int:
        """End of the range, or of what has been recorded so far, in ns of simulated time."""
        end_ns = self._span.end_ns
        return self._cursor.end_ns if end_ns is None else min(end_ns, self._cursor.end_ns)

    @property
    def paused(self) -> bool:
        """Whether the replay is paused."""
        return self._playback.paused

    def pump(self) -> int:
        """Publish due messages; returns their number.

        Raises:
            TouchlineError: the recording is damaged there.
        """
        if not self._has_begun:
            self._has_begun = True
            for latched in self._cursor.latched(self._span.start_ns, is_latched):
                self._emit(latched)
        before = self.published
        while self.published - before < _MAX_AT_ONCE and not self.ended:
            message = self._next()
            if message is None:
                self._at_end()
                break
            if message.log_ns != self._open_ns and not self._open(message.log_ns):
                break
            self._latched[message.key] = message
            self._emit(message)
            self._cursor.skip()
            self._is_at_start = False
        return self.published - before

    def wait(self) -> float:
        """Wall time in s until a message is due; infinite while paused."""
        if self._steps or self.ended:
            return 0.0
        message = self._next()
        return POLL_S if message is None else self._playback.wait(message.log_ns, self._clock.now())

    def republish_latched(self) -> None:
        """Publish the latched messages again, for listeners that arrived later."""
        for message in self._latched.values():
            if is_latched(message.topic):
                self._emit(message)

    def control(self, request: ReplayRequest) -> ReplayReply:
        """Carry out a request, or return the reason for its refusal."""
        try:
            self._carry_out(request)
        except TouchlineError as error:
            return self.status(accepted=False, reason=str(error))
        if request.operation is not ReplayOperation.EVENTS:
            return self.status()
        return self.status().replace(events=self._events(), topics=list(self._topics))

    def status(self, *, accepted: bool = True, reason: str = "") -> ReplayReply:
        """The state of the replay, as a reply."""
        rate = self._playback.rate
        return ReplayReply(
            accepted=accepted,
            reason=reason,
            time=self.position_ns / 1e9,
            start=self._span.start_ns / 1e9,
            end=self.end_ns / 1e9,
            rate=None if math.isinf(rate) else rate,
            paused=self.paused,
            loop=self._loop,
            messages=self.published,
        )

    def _emit(self, message: Playable) -> None:
        self._publish(message)
        self.published += 1

    def _next(self) -> Playable | None:
        """The next message; None at the end of the range."""
        end_ns = self._span.end_ns
        message: Playable | None = self._cursor.peek()
        return message if message is not None and (end_ns is None or message.log_ns <= end_ns) else None

    def _open(self, ns: int) -> bool:
        """Begin to publish the messages of this simulated time if they are due; returns whether they are."""
        if not self._steps and (self.paused or ns > self._playback.due_ns(self._clock.now())):
            return False
        if not self._can_publish():
            return False
        self._steps = max(0, self._steps - 1)
        self._open_ns = self._position_ns = ns
        return True

    def _at_end(self) -> None:
        """At the end of the range: wait for more data, start again, pause, or end."""
        self._steps = 0
        now = self._clock.now()
        if self._follow and not self._cursor.finished and self._cursor.peek() is None:
            if now - self._checked_at >= POLL_S:
                self._checked_at = now
                self._cursor.grow()
            self._playback = self._playback.moved(self._position_ns, now)
        elif self.paused:
            return
        elif self._loop and not self._is_at_start:
            self._jump_to(self._span.start_ns)
        elif self._stay:
            self._playback = self._playback.changed(self._position_ns, now, paused=True)
        else:
            self.ended = True

    def _seek_to(self, ns: int) -> None:
        """Move to the first message at this simulated time or later, and read the latched messages there."""
        self._cursor.seek(ns)
        self._latched = {message.key: message for message in self._cursor.latched(ns + 1, is_latched)}
        self._position_ns, self._open_ns, self._steps = ns, None, 0
        self._playback = self._playback.moved(ns, self._clock.now())
        self._is_at_start = ns == self._span.start_ns

    def _jump_to(self, ns: int) -> None:
        """Continue from this simulated time, and publish the latched messages there."""
        self._seek_to(ns)
        self.republish_latched()

    def _change(self, *, rate: float | None = None, paused: bool | None = None) -> None:
        now, here = self._clock.now(), self.position_ns
        self._playback = self._playback.changed(here, now, rate=rate, paused=paused)
        self._position_ns = here

    def _carry_out(self, request: ReplayRequest) -> None:
        """Carry out a request; `status` and `events` change nothing."""
        match request.operation:
            case ReplayOperation.PLAY:
                self._steps = 0
                self._change(paused=False)
            case ReplayOperation.PAUSE:
                self._change(paused=True)
            case ReplayOperation.STEP:
                self._change(paused=True)
                self._steps = request.ticks
            case ReplayOperation.SEEK:
                self._seek(request)
            case ReplayOperation.RATE:
                self._change(rate=AS_FAST_AS_POSSIBLE if request.rate is None else request.rate)
            case ReplayOperation.LOOP:
                self._loop = not self._loop
            case ReplayOperation.LEAVE:
                self.ended = True

    def _seek(self, request: ReplayRequest) -> None:
        if (request.to is None) == (request.by is None):
            raise TouchlineError("seek requires either to, a target, or by, a distance in seconds")
        if request.to is not None:
            ns = self._time_of(request.to) * 1e9
        else:
            ns = self.position_ns + (request.by or 0.0) * 1e9
        self._has_begun = True
        self._jump_to(round(max(self._span.start_ns, min(ns, self.end_ns))))
