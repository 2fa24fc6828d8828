"""Computes all figures of a recording in one pass."""

from collections.abc import Callable, Iterator
from typing import Any

from recordings.reading.recording import Recording
from recordings.soccer.stats.ball_control import BallControl
from recordings.soccer.stats.crowding import Crowding
from recordings.soccer.stats.dribbles import DribbleTracker
from recordings.soccer.stats.figures import Coverage, FigureBuilder, MatchFigures
from recordings.soccer.stats.kicks import KickTracker
from recordings.soccer.stats.match_tick import GAP, KEYS, MatchTick, match_ticks
from recordings.soccer.stats.momentum import Momentum
from recordings.soccer.stats.motion import MotionTracker
from recordings.soccer.stats.referee_calls import RefereeCalls
from schemas.config.free import GameName
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.messages.world import World

MAX_TIME_DIFFERENCE_S = 1.0
"""s between the time in a world and its log time; with a larger difference the world is invalid. Chosen here."""


def match_ticks_of(recording: Recording) -> Iterator[MatchTick]:
    """Yield the ticks of a recording, in order; worlds with an impossible time count as unreadable.

    Raises:
        TouchlineError: the file is damaged inside, or has no setup.
    """
    return match_ticks(recording.setup, _messages(recording))


def _messages(recording: Recording) -> Iterator[tuple[int, Any]]:
    for recorded, message in recording.decoded(*KEYS):
        if isinstance(message, World) and abs(message.time - recorded.time) > MAX_TIME_DIFFERENCE_S:
            recording.unreadable[recorded.key] += 1
        else:
            yield recorded.log_ns, message


TickObserver = Callable[[MatchTick], None]
"""Is called with each tick."""


class MatchStatistics:
    """Accumulates the figures of a match, tick by tick."""

    def __init__(self, setup: Setup, start: float, end: float) -> None:
        """`start` and `end` are in s of simulated time.

        Raises:
            TouchlineError: another game than soccer is played.
        """
        if setup.game is not GameName.SOCCER:
            raise TouchlineError(f'the match is of the game "{setup.game}", and these figures are of soccer')
        self._setup = setup
        self._control = BallControl()
        self._crowding = Crowding()
        self._motions = MotionTracker()
        self._dribbles = DribbleTracker()
        self._kicks = KickTracker(setup)
        self._calls = RefereeCalls()
        self._observers: tuple[TickObserver, ...] = (
            self._control.update,
            self._crowding.update,
            self._motions.update,
            self._dribbles.update,
            self._kicks.update,
            self._calls.update,
        )
        self._momentum = Momentum(start, end, setup.pitch.goal_line)
        self._worlds = self._touched = self._held = self._states = 0
        self._missing = 0.0
        self._first: MatchTick | None = None
        self._last: MatchTick | None = None

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick."""
        self._momentum.update(match_tick, self._control.side)
        for observe in self._observers:
            observe(match_tick)
        world = match_tick.world
        self._worlds += 1
        self._touched += bool(world.touches)
        self._held += world.possession is not None
        self._states += match_tick.state is not match_tick.state_before
        step = world.time - self._last.world.time if self._last is not None else 0.0
        self._missing += step if step > GAP else 0.0
        self._first = self._first or match_tick
        self._last = match_tick

    def figures(self, unreadable: int = 0) -> MatchFigures:
        """Return the figures; `unreadable` is the number of messages that could not be decoded.

        Raises:
            TouchlineError: no tick was added.
        """
        if self._first is None or self._last is None:
            raise TouchlineError("no world could be read, so there is nothing to measure")
        self._dribbles.end()
        self._kicks.end(self._last)
        coverage = Coverage(
            worlds=self._worlds,
            touched=self._touched,
            held=self._held,
            kicks=len(self._kicks.kicks),
            states=self._states,
            events=len(self._calls.events),
            missing=self._missing,
            unreadable=unreadable,
        )
        return FigureBuilder(
            setup=self._setup,
            lineup=self._last.lineup,
            extent=(self._first.world.time, self._last.world.time),
            coverage=coverage,
            control=self._control,
            crowding=self._crowding,
            motions=self._motions.robots,
            dribbles=self._dribbles.robots,
            kicks=self._kicks.kicks,
            calls=self._calls,
            momentum=self._momentum,
        ).figures()


def figures_of_recording(recording: Recording, *observers: TickObserver) -> MatchFigures:
    """The figures of a recording; `observers` are updated with the same ticks, in the same pass.

    Raises:
        TouchlineError: the recording is damaged inside, or has no setup or no world.
    """
    setup, (start, end) = recording.setup, recording.extent_of_worlds()
    statistics, before = MatchStatistics(setup, start, end), recording.unreadable.total()
    for match_tick in match_ticks_of(recording):
        statistics.update(match_tick)
        for other in observers:
            other(match_tick)
    return statistics.figures(recording.unreadable.total() - before)
