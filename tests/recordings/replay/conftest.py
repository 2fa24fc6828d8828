"""A recording of 200 ticks, a clock that passes when it is told to, and a player whose messages are kept."""

from collections.abc import Callable
from dataclasses import dataclass, field

import pytest

from recordings.reading.cursor import Cursor
from recordings.reading.recording import RecordedMessage, Recording
from recordings.replay.player import PlaybackRange, Player
from schemas.game import Phase, Score
from schemas.process.clock import SteppedClock
from schemas.topics import WORLD

TICK = 0.02


@pytest.fixture
def recorded(rig) -> Recording:
    """Play from tick 0, a goal and a kick-off at 100, full time at 199."""
    rig.host.referee(0, Phase.PLAY, Score())
    rig.play(range(100))
    rig.host.goal(100)
    rig.host.referee(100, Phase.KICK_OFF, Score(cyan=1))
    rig.play(range(100, 200))
    rig.host.referee(199, Phase.FULL_TIME, Score(cyan=1))
    rig.leave()
    return rig.read()


@dataclass
class PlayerRig:
    """A player, its clock, and what it has said."""

    player: Player
    clock: SteppedClock
    heard: list[RecordedMessage] = field(default_factory=list)

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
def make_player_rig(recorded: Recording) -> Callable[..., PlayerRig]:
    """Makes a player with the recording in it; the span is given in s."""

    def make(start: float = 0.0, end: float | None = None, **options) -> PlayerRig:
        clock, heard = SteppedClock(), []
        span = PlaybackRange(round(start * 1e9), None if end is None else round(end * 1e9))
        return PlayerRig(Player(Cursor(recorded.path), clock, heard.append, span, **options), clock, heard)

    return make
