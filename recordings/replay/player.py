"""The player: a pure core over messages, clock and controls. It says the messages of a tape when their time has come.

At any rate the order is that of the tape. It knows neither bus nor file: whoever owns it gives it a tape and an ear.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from recordings.reader import Recorded
from recordings.reel import Reel
from recordings.replay.transport import AS_FAST_AS_POSSIBLE, Transport
from recordings.tape import Tape
from schemas.clock import Clock
from schemas.errors import TouchlineError
from schemas.game import GameEvent
from schemas.replay import ReplayDeed, ReplayReply, ReplayRequest
from schemas.topic import Topic
from schemas.topics import APPLIED, BELIEF, COMMAND, HEALTH, ORDER, SIGHT, STANDING_ORDER, STATE, WORLD

STANDING = frozenset(
    topic.key for topic in (WORLD, STATE, APPLIED, HEALTH, COMMAND, SIGHT, BELIEF, ORDER, STANDING_ORDER)
)
"""Topics whose newest message says how things stand; events and complaints have happened, and do not stand."""
_AT_ONCE = 500
"""Messages after which controls are looked at again."""
_LOOK_S = 0.1
"""Wall time between two looks for what a recorder has added."""


@dataclass(frozen=True, slots=True)
class Span:
    """What of a tape is played; simulated time in ns."""

    start_ns: int
    end_ns: int | None = None
    """Up to and with this; to the end of the tape when not given."""


def stands(topic: Topic) -> bool:
    """Whether the newest message of this topic says how things stand."""
    return topic.key in STANDING


class Player:
    """A tape that is played."""

    def __init__(
        self,
        tape: Tape | Reel,
        clock: Clock,
        say: Callable[[Recorded], None],
        span: Span | None = None,
        *,
        rate: float = 1.0,
        paused: bool = False,
        loop: bool = False,
        stay: bool = False,
        follow: bool = False,
        time_of: Callable[[str], float] = float,
        events: Callable[[], list[GameEvent]] = list,
        has_room: Callable[[], bool] = lambda: True,
    ) -> None:
        """Stand at the beginning of `span`, with nothing said yet.

        `stay` pauses at the end instead of ending, `follow` waits there for what a recorder adds. `time_of` gives the
        simulated time in s that words name, `events` all that happens in the recording. Nothing of a new moment is said
        before there is room for it, as `has_room` says.
        """
        self._tape, self._clock, self._say = tape, clock, say
        self._span = span or Span(tape.start_ns)
        self._stay, self._follow, self._loop = stay, follow, loop
        self._time_of, self._events, self._has_room = time_of, events, has_room
        self._standing: dict[str, Recorded] = {}
        self._transport = Transport(self._span.start_ns, clock.now(), rate, paused)
        self._position_ns = self._span.start_ns
        self._open_ns: int | None = None
        self._steps = 0
        self._looked_at = -math.inf
        self._said = 0
        self._has_begun = self._is_at_start = False
        self.ended = False
        """Nothing more will be said."""
        self._wind(self._span.start_ns)

    @property
    def position_ns(self) -> int:
        """Where it is, ns of simulated time."""
        if self.paused or math.isinf(self._transport.rate):
            return self._position_ns
        message = self._next()
        ahead = message.log_ns if message is not None else self._position_ns
        return max(self._position_ns, min(round(self._transport.due_ns(self._clock.now())), ahead))

    @property
    def end_ns(self) -> int:
        """Where it ends, or how far it can be played by now, ns of simulated time."""
        end_ns = self._span.end_ns
        return self._tape.end_ns if end_ns is None else min(end_ns, self._tape.end_ns)

    @property
    def paused(self) -> bool:
        """It stands still."""
        return self._transport.paused

    @property
    def said(self) -> int:
        """Messages said so far."""
        return self._said

    def pump(self) -> int:
        """Say what is due; returns how many messages that were.

        Raises:
            TouchlineError: the recording is damaged there.
        """
        if not self._has_begun:
            self._has_begun = True
            for standing in self._tape.standing(self._span.start_ns, stands):
                self._tell(standing)
        before = self._said
        while self._said - before < _AT_ONCE and not self.ended:
            message = self._next()
            if message is None:
                self._at_the_end()
                break
            if message.log_ns != self._open_ns and not self._open(message.log_ns):
                break
            self._standing[message.key] = message
            self._tell(message)
            self._tape.skip()
            self._is_at_start = False
        return self._said - before

    def wait(self) -> float:
        """Wall time in s until something is due; for ever while it stands still."""
        if self._steps or self.ended:
            return 0.0
        message = self._next()
        return _LOOK_S if message is None else self._transport.wait(message.log_ns, self._clock.now())

    def tell_standing(self) -> None:
        """Say again how things stand, for those who came late."""
        for message in self._standing.values():
            if stands(message.topic):
                self._tell(message)

    def control(self, request: ReplayRequest) -> ReplayReply:
        """Do what is asked, or say why not."""
        try:
            _DEEDS[request.deed](self, request)
        except TouchlineError as error:
            return self.status(accepted=False, reason=str(error))
        told = self._events() if request.deed is ReplayDeed.EVENTS else []
        return self.status().model_copy(update={"events": told})

    def status(self, *, accepted: bool = True, reason: str = "") -> ReplayReply:
        """How it stands."""
        rate = self._transport.rate
        return ReplayReply(
            accepted=accepted,
            reason=reason,
            time=self.position_ns / 1e9,
            start=self._span.start_ns / 1e9,
            end=self.end_ns / 1e9,
            rate=None if math.isinf(rate) else rate,
            paused=self.paused,
            loop=self._loop,
            messages=self._said,
        )

    def _tell(self, message: Recorded) -> None:
        self._say(message)
        self._said += 1

    def _next(self) -> Recorded | None:
        """The message that comes next; nothing at the end of what is played."""
        message, end_ns = self._tape.peek(), self._span.end_ns
        return message if message is not None and (end_ns is None or message.log_ns <= end_ns) else None

    def _open(self, ns: int) -> bool:
        """Whether messages of this simulated time may be said now; those of one moment are said together."""
        if not self._steps and (self.paused or ns > self._transport.due_ns(self._clock.now())):
            return False
        if not self._has_room():
            return False
        self._steps = max(0, self._steps - 1)
        self._open_ns = self._position_ns = ns
        return True

    def _at_the_end(self) -> None:
        """Wait for more, begin again, stay, or end."""
        self._steps = 0
        now = self._clock.now()
        if self._follow and not self._tape.finished and self._tape.peek() is None:
            if now - self._looked_at >= _LOOK_S:
                self._looked_at = now
                self._tape.grow()
            self._transport = self._transport.moved(self._position_ns, now)
        elif self.paused:
            return
        elif self._loop and not self._is_at_start:
            self._go_to(self._span.start_ns)
        elif self._stay:
            self._transport = self._transport.changed(self._position_ns, now, paused=True)
        else:
            self.ended = True

    def _wind(self, ns: int) -> None:
        """Stand before the first message at this simulated time or later, and know how things stand there."""
        self._tape.seek(ns)
        self._standing = {message.key: message for message in self._tape.standing(ns + 1, stands)}
        self._position_ns, self._open_ns, self._steps = ns, None, 0
        self._transport = self._transport.moved(ns, self._clock.now())
        self._is_at_start = ns == self._span.start_ns

    def _go_to(self, ns: int) -> None:
        """Go on from there; everybody is told how things stand there."""
        self._wind(ns)
        self.tell_standing()

    def _change(self, *, rate: float | None = None, paused: bool | None = None) -> None:
        now, here = self._clock.now(), self.position_ns
        self._transport = self._transport.changed(here, now, rate=rate, paused=paused)
        self._position_ns = here

    def _play(self, request: ReplayRequest) -> None:
        del request
        self._steps = 0
        self._change(paused=False)

    def _pause(self, request: ReplayRequest) -> None:
        del request
        self._change(paused=True)

    def _step(self, request: ReplayRequest) -> None:
        self._change(paused=True)
        self._steps = request.ticks

    def _seek(self, request: ReplayRequest) -> None:
        if (request.to is None) == (request.by is None):
            raise TouchlineError("seek needs one of to and by: where to, or how far from here")
        if request.to is not None:
            ns = round(self._time_of(request.to) * 1e9)
        else:
            ns = self.position_ns + round((request.by or 0.0) * 1e9)
        self._has_begun = True
        self._go_to(max(self._span.start_ns, min(ns, self.end_ns)))

    def _rate(self, request: ReplayRequest) -> None:
        self._change(rate=AS_FAST_AS_POSSIBLE if request.rate is None else request.rate)

    def _switch_loop(self, request: ReplayRequest) -> None:
        del request
        self._loop = not self._loop

    def _leave(self, request: ReplayRequest) -> None:
        del request
        self.ended = True

    def _say_status(self, request: ReplayRequest) -> None:
        """Nothing is to be done."""


_DEEDS: dict[ReplayDeed, Callable[[Player, ReplayRequest], None]] = {
    ReplayDeed.STATUS: Player._say_status,
    ReplayDeed.EVENTS: Player._say_status,
    ReplayDeed.PLAY: Player._play,
    ReplayDeed.PAUSE: Player._pause,
    ReplayDeed.STEP: Player._step,
    ReplayDeed.SEEK: Player._seek,
    ReplayDeed.RATE: Player._rate,
    ReplayDeed.LOOP: Player._switch_loop,
    ReplayDeed.LEAVE: Player._leave,
}
"""Deed → what the player does."""
