"""A recording of 200 ticks on a tape, a clock that passes when it is told to, and an ear for what a player says."""

from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Event
from typing import Any

import pytest

from recordings.reader import Recorded, Recording
from recordings.replay.player import Player, Span
from recordings.tape import Tape
from schemas.clock import SteppedClock
from schemas.game import Phase, Score
from schemas.topics import WORLD

TICK = 0.02


@pytest.fixture
def recorded(stage) -> Recording:
    """Play from tick 0, a goal and a kick-off at 100, full time at 199."""
    stage.host.referee(0, Phase.PLAY, Score())
    stage.play(range(100))
    stage.host.goal(100)
    stage.host.referee(100, Phase.KICK_OFF, Score(cyan=1))
    stage.play(range(100, 200))
    stage.host.referee(199, Phase.FULL_TIME, Score(cyan=1))
    stage.leave()
    return stage.read()


@pytest.fixture
def written() -> Callable[[Any], None]:
    """Waits until what a recorder has handed on is in its file."""

    def wait(stage) -> None:
        done = Event()
        stage.output.sync()
        stage.output._writer._hand_over(done.set)
        assert done.wait(30.0)

    return wait


@dataclass
class Deck:
    """A player, its clock, and what it has said."""

    player: Player
    clock: SteppedClock
    heard: list[Recorded] = field(default_factory=list)

    def run(self, seconds: float, step: float = 0.001) -> None:
        """Let wall time pass."""
        end = self.clock.now() + seconds
        while self.clock.now() < end - 1e-12 and not self.player.ended:
            self.player.pump()
            self.clock.sleep_until(min(end, self.clock.now() + step))
        self.player.pump()

    def finish(self) -> None:
        """Let it come to its end."""
        while not self.player.ended:
            if not self.player.pump():
                self.clock.sleep_until(self.clock.now() + max(1e-6, self.player.wait()))

    def ticks(self, since: int = 0) -> list[int]:
        """Ticks of the worlds that were said."""
        return [one.message().tick for one in self.heard[since:] if one.topic is WORLD]


@pytest.fixture
def deck(recorded: Recording) -> Callable[..., Deck]:
    """Makes a deck with the recording in it; the span is given in s."""

    def make(start: float = 0.0, end: float | None = None, **options) -> Deck:
        clock, heard = SteppedClock(), []
        span = Span(round(start * 1e9), None if end is None else round(end * 1e9))
        return Deck(Player(Tape(recorded.path), clock, heard.append, span, **options), clock, heard)

    return make
