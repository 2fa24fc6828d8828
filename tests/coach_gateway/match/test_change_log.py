import threading

import pytest

from coach_gateway.match.change_log import log_changes
from schemas.bus.in_process_bus import SharedState
from schemas.errors import TouchlineError
from schemas.game import EventKind, Phase, Score
from schemas.messages.game import GameEvent, GameState
from schemas.process.clock import SteppedClock
from schemas.side import Side
from schemas.topics import EVENT, STATE


class HostOf:
    """A host that publishes its next message whenever the watcher's clock advances, and leaves after the last."""

    def __init__(self, *messages: GameState | GameEvent) -> None:
        self.medium = SharedState()
        self.bus = self.medium.open_bus("friendly", SteppedClock())
        self.bus.declare_alive("host", "host")
        self._messages = list(messages)
        self._states, self._events = self.bus.publisher(STATE), self.bus.publisher(EVENT)

    def advance(self) -> None:
        if not self._messages:
            self.bus.close()
            return
        message = self._messages.pop(0)
        (self._states if isinstance(message, GameState) else self._events).put(message)


class DrivingClock(SteppedClock):
    """Lets the host go on whenever the watcher sleeps."""

    __slots__ = ("host",)

    def sleep_until(self, moment: float) -> None:
        super().sleep_until(moment)
        self.host.advance()


def lines_of(*messages: GameState | GameEvent) -> list[str]:
    host = HostOf(*messages)
    clock = DrivingClock()
    clock.host = host
    said: list[str] = []
    log_changes(host.medium.open_bus("friendly", clock), said.append, threading.Event())
    return said


def state(clock: float, phase: Phase = Phase.PLAY, side: Side | None = None, running: bool = False) -> GameState:
    return GameState(tick=1, time=clock, clock=clock, phase=phase, side=side, running=running, score=Score(cyan=2))


def test_a_line_is_logged_when_something_changes_and_not_when_only_the_clock_runs() -> None:
    said = lines_of(state(0.0), state(1.0), state(61.25, Phase.THROW_IN, Side.MAGENTA), state(62.0))
    assert said == [
        " 0:00.0  half 1  cyan 2 : 0 magenta  play",
        " 1:01.2  half 1  cyan 2 : 0 magenta  throw in, magenta",
        " 1:02.0  half 1  cyan 2 : 0 magenta  play",
    ]


def test_every_event_is_logged_with_its_text() -> None:
    event = GameEvent(tick=5, time=0.1, clock=0.1, kind=EventKind.BALL_OUT, rule="ball_out", text="over the touch line")
    assert lines_of(event, event) == [" 0:00.1  ball out: over the touch line"] * 2


def test_watching_a_match_without_a_host_is_an_error_with_the_reason() -> None:
    bus = SharedState().open_bus("cup", SteppedClock())
    with pytest.raises(TouchlineError, match='match "cup": no host plays it there'):
        log_changes(bus, lambda line: None, threading.Event())


def test_a_stop_ends_the_watch_while_the_host_goes_on() -> None:
    host = HostOf()
    stop = threading.Event()
    stop.set()
    log_changes(host.medium.open_bus("friendly", SteppedClock()), lambda line: None, stop)
    assert host.bus.connected()
