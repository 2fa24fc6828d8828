"""The random numbers of a camera's picture: which things each robot detects, and the noise of their places.

A pair is a robot and a thing, by its index in the array robots × things. The numbers of a pair depend on its names and
the tick alone, so both classes give the same ones: `AllPairs` draws those of all pairs for many pictures at once,
`SinglePairs` those of the pairs in view in each picture.
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
from sim_host.sensing.sight_lines import Flags, Indices

_MANY_PAIRS = 700
"""From this number on, `SinglePairs` costs less in a picture; below it, numpy's overhead would double its cost."""


class PairDraws(Protocol):
    """The draws of one set of robots and things."""

    def detected(self, number: int, pairs: Indices) -> tuple[Indices, Floats]:
        """Those of these pairs whose thing is detected in picture `number`, with their noise.

        The noise, shape (2, pairs), is along and across the line of sight, in units of its standard deviation.
        """


def pair_draws(
    sensing: Sensing, streams: RandomStreams, shutter: Shutter, robots: Sequence[str], things: Sequence[str]
) -> PairDraws:
    """The cheaper draws for this number of pairs; the first of the things is the ball."""
    kind = AllPairs if len(robots) * len(things) < _MANY_PAIRS else SinglePairs
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

    def detected(self, number: int, pairs: Indices) -> tuple[Indices, Floats]:
        """See `PairDraws`."""
        noise, is_detected = self._draws.at(number)
        pairs = pairs.compress(is_detected.take(pairs))
        return pairs, noise.take(pairs, axis=1)

    def _draw(self, numbers: range) -> list[tuple[Floats, Flags]]:
        """Per picture: the noise of all pairs, and which of them are detected."""
        ticks = [self._shutter.tick_of(number) for number in numbers]
        drawn = self._streams.pairwise_uniforms(StreamId.SEEN, self._robots, self._things, ticks)
        noise = normal_pairs(drawn[..., :2]) * (drawn[..., 3:] < self._noise_rate)
        is_detected = drawn[..., 2] >= self._dropout
        shape = (len(ticks), len(self._robots) * len(self._things))
        by_part = np.ascontiguousarray(np.moveaxis(noise.reshape(*shape, 2), -1, 1))
        return list(zip(by_part, is_detected.reshape(shape), strict=True))


class SinglePairs:
    """Draws for the pairs in view, picture by picture."""

    def __init__(
        self, sensing: Sensing, streams: RandomStreams, shutter: Shutter, robots: Sequence[str], things: Sequence[str]
    ) -> None:
        self._streams = streams
        self._shutter = shutter
        self._robot_words = name_words(robots).repeat(len(things))
        self._thing_words = np.tile(name_words(things), len(robots))
        self._dropout = np.tile(_dropouts(sensing, len(things)), len(robots))
        self._noise_rate = sensing.noise_rate

    def detected(self, number: int, pairs: Indices) -> tuple[Indices, Floats]:
        """See `PairDraws`."""
        robots, things = self._robot_words.take(pairs), self._thing_words.take(pairs)
        drawn = self._streams.uniforms_of_pairs(StreamId.SEEN, robots, things, self._shutter.tick_of(number))
        is_detected = drawn[:, 2] >= self._dropout.take(pairs)
        drawn = drawn[is_detected]
        noise = normal_pairs(drawn[:, :2]) * (drawn[:, 3:] < self._noise_rate)
        return pairs.compress(is_detected), np.ascontiguousarray(noise.T)


def _dropouts(sensing: Sensing, things: int) -> Floats:
    """Per thing: the probability that it is missed in a picture."""
    return np.array([sensing.ball_dropout] + [sensing.obstacle_dropout] * (things - 1))
