"""The random numbers of a camera's picture: which things each robot detects, and the noise of their places.

The numbers of a pair of a robot and a thing depend on their names and the tick alone. So both classes give the same
ones: `AllPairs` draws for all pairs and many pictures together, `PairsInView` for the pairs in view alone.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from schemas.config.sections import Sensing
from sim_host.sensing.random_streams import (
    SMALL_BATCH,
    BatchedDraws,
    Floats,
    RandomStreams,
    StreamId,
    name_words,
    normal_pairs,
)
from sim_host.sensing.shutter import Shutter
from sim_host.sensing.sight_lines import Flags

MANY_PAIRS = 1800
"""From this number on, `PairsInView` costs less. With few pairs, it costs six times as much: the overhead of numpy."""


class PairDraws(Protocol):
    """The draws of one set of robots and things."""

    def detect(self, number: int, found: Flags) -> Floats:
        """Remove what is not detected in picture `number` from the things that each robot has in view.

        Returns the noise along and across the line of sight in units of its standard deviation, shape (2, robots,
        things); meaningless where nothing was in view. It is valid until the next call.
        """


def pair_draws(
    sensing: Sensing, streams: RandomStreams, shutter: Shutter, robots: Sequence[str], things: Sequence[str]
) -> PairDraws:
    """The cheaper draws for this number of pairs; the first of the things is the ball."""
    kind = AllPairs if len(robots) * len(things) < MANY_PAIRS else PairsInView
    return kind(sensing, streams, shutter, robots, things)


class AllPairs:
    """Draws for all pairs, in batches of pictures."""

    def __init__(
        self, sensing: Sensing, streams: RandomStreams, shutter: Shutter, robots: Sequence[str], things: Sequence[str]
    ) -> None:
        self._streams = streams
        self._shutter = shutter
        self._robots, self._things = robots, things
        self._dropout = _dropouts(sensing, len(things))
        self._noise_rate = sensing.noise_rate
        self._draws = BatchedDraws(self._draw, SMALL_BATCH)

    def detect(self, number: int, found: Flags) -> Floats:
        """See `PairDraws`."""
        noise, is_detected = self._draws.at(number)
        found &= is_detected
        return noise

    def _draw(self, numbers: range) -> list[tuple[Floats, Flags]]:
        """Per picture: the noise of all pairs, and which of them are detected."""
        ticks = [self._shutter.tick_of(number) for number in numbers]
        drawn = self._streams.pairwise_uniforms(StreamId.SEEN, self._robots, self._things, ticks)
        noise = normal_pairs(drawn[..., :2]) * (drawn[..., 3:] < self._noise_rate)
        is_detected = drawn[..., 2] >= self._dropout
        return list(zip(np.ascontiguousarray(np.moveaxis(noise, -1, 1)), is_detected, strict=True))


class PairsInView:
    """Draws for the pairs in view, picture by picture."""

    def __init__(
        self, sensing: Sensing, streams: RandomStreams, shutter: Shutter, robots: Sequence[str], things: Sequence[str]
    ) -> None:
        self._streams = streams
        self._shutter = shutter
        self._robots, self._things = name_words(robots), name_words(things)
        self._dropout = _dropouts(sensing, len(things))
        self._noise_rate = sensing.noise_rate
        self._noise = np.zeros((2, len(robots), len(things)))

    def detect(self, number: int, found: Flags) -> Floats:
        """See `PairDraws`."""
        robot, thing = found.nonzero()
        robots, things = self._robots.take(robot), self._things.take(thing)
        drawn = self._streams.uniforms_of_pairs(StreamId.SEEN, robots, things, self._shutter.tick_of(number))
        found[found] = drawn[:, 2] >= self._dropout.take(thing)
        self._noise[:, robot, thing] = (normal_pairs(drawn[:, :2]) * (drawn[:, 3:] < self._noise_rate)).T
        return self._noise


def _dropouts(sensing: Sensing, things: int) -> Floats:
    """Per thing: the probability that it is missed in a picture."""
    return np.array([sensing.ball_dropout] + [sensing.obstacle_dropout] * (things - 1))
