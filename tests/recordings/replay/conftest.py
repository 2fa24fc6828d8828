"""A recording of 200 ticks, a stepped clock, and a player whose messages are kept."""

from collections.abc import Callable

import pytest

from recordings.reading.cursor import Cursor
from recordings.reading.recording import Recording
from recordings.replay.player import PlaybackRange, Player
from schemas.soccer.game import Phase, Score
from support.player_rig import PlayerRig
from support.stepped_clock import SteppedClock

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


@pytest.fixture
def make_player_rig(recorded: Recording) -> Callable[..., PlayerRig]:
    """Makes a player with the recording in it; the span is given in s."""

    def make(start: float = 0.0, end: float | None = None, **options) -> PlayerRig:
        clock, published = SteppedClock(), []
        span = PlaybackRange(round(start * 1e9), None if end is None else round(end * 1e9))
        return PlayerRig(Player(Cursor(recorded.path), clock, published.append, span, **options), clock, published)

    return make
