"""All figures of a recording in one reading."""

from collections.abc import Iterator
from typing import Any, Protocol

from recordings.reader import Recording
from recordings.stats.calls import Calls
from recordings.stats.carries import Carries
from recordings.stats.control import Control
from recordings.stats.figures import Evidence, Figures, figures_of
from recordings.stats.kicks import Kicks
from recordings.stats.moment import GAP, KEYS, Moment, moments
from recordings.stats.momentum import Momentum
from recordings.stats.motion import Motions
from schemas.errors import TouchlineError
from schemas.host import Setup
from schemas.topics import WORLD
from schemas.world import World


def setup_of(recording: Recording) -> Setup:
    """How the match was set up.

    Raises:
        TouchlineError: the recording does not say.
    """
    setup = recording.manifest.setup
    if setup is None:
        raise TouchlineError(
            f"{recording.path}: its manifest has no setup, so pitch and teams are unknown; "
            "record with the host running from the start"
        )
    return setup


def extent(recording: Recording) -> tuple[float, float]:
    """Simulated times of the first and the last world, s.

    Raises:
        TouchlineError: there is none.
    """
    for channel in recording.channels:
        if channel.key == WORLD.key and channel.messages:
            return channel.start, channel.end
    raise TouchlineError(f"{recording.path}: no world in it, so there is nothing to measure; record the key world")


APART = 1.0
"""s; ours: a world whose own time is farther from that of its record is not what the host wrote."""


def moments_of(recording: Recording) -> Iterator[Moment]:
    """The moments of a recording, in order; worlds of an impossible time are counted as unreadable.

    Raises:
        TouchlineError: the file is damaged inside, or does not say how the match was set up.
    """
    return moments(setup_of(recording), _messages(recording))


def _messages(recording: Recording) -> Iterator[tuple[int, Any]]:
    for recorded, message in recording.decoded(*KEYS):
        if isinstance(message, World) and abs(message.time - recorded.time) > APART:
            recording.unreadable[recorded.key] += 1
        else:
            yield recorded.log_ns, message


class Taker(Protocol):
    """Takes in moments, one after the other."""

    def take(self, moment: Moment) -> None:
        """One more tick."""


class Measure:
    """Takes in moment after moment, and gives the figures of all."""

    def __init__(self, setup: Setup, start: float, end: float) -> None:
        """Of a match with this setup, from `start` to `end`, s of simulated time."""
        self._setup = setup
        self._control = Control()
        self._motions = Motions()
        self._carries = Carries()
        self._kicks = Kicks(setup)
        self._calls = Calls()
        self._figures: tuple[Taker, ...] = (self._control, self._motions, self._carries, self._kicks, self._calls)
        self._momentum = Momentum(start, end, setup.pitch.goal_line)
        self._worlds = self._touched = self._held = self._states = 0
        self._missing = 0.0
        self._first: Moment | None = None
        self._last: Moment | None = None

    def take(self, moment: Moment) -> None:
        """One more tick."""
        self._momentum.take(moment, self._control.side)
        for figure in self._figures:
            figure.take(moment)
        world = moment.world
        self._worlds += 1
        self._touched += bool(world.touches)
        self._held += world.possession is not None
        self._states += moment.state is not moment.state_before
        waited = world.time - self._last.world.time if self._last is not None else 0.0
        self._missing += waited if waited > GAP else 0.0
        self._first = self._first or moment
        self._last = moment

    def figures(self, unreadable: int = 0) -> Figures:
        """What it comes to; `unreadable` messages could not be taken in.

        Raises:
            TouchlineError: there was no moment at all.
        """
        if self._first is None or self._last is None:
            raise TouchlineError("no world could be read, so there is nothing to measure")
        self._carries.end()
        self._kicks.end(self._last)
        evidence = Evidence(
            worlds=self._worlds,
            touched=self._touched,
            held=self._held,
            kicks=len(self._kicks.stories),
            states=self._states,
            events=len(self._calls.events),
            missing=self._missing,
            unreadable=unreadable,
        )
        return figures_of(
            setup=self._setup,
            cast=self._last.cast,
            first=self._first.world.time,
            last=self._last.world.time,
            evidence=evidence,
            control=self._control,
            motions=self._motions,
            carries=self._carries,
            kicks=self._kicks.stories,
            calls=self._calls,
            momentum=self._momentum,
        )


def figures_of_recording(recording: Recording, *also: Taker) -> Figures:
    """The figures of a recording; whatever `also` is given takes in the same moments, in the same reading.

    Raises:
        TouchlineError: it is damaged inside, has no setup, or no world.
    """
    setup, (start, end) = setup_of(recording), extent(recording)
    all_figures, before = Measure(setup, start, end), recording.unreadable.total()
    for moment in moments_of(recording):
        all_figures.take(moment)
        for other in also:
            other.take(moment)
    return all_figures.figures(recording.unreadable.total() - before)
