"""Counter-based random streams: a number depends on (seed, stream, robot, tick, index) alone.

Philox4x32-10 (Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11), vectorised.
There is no state: draws do not affect each other, and can be made in any order, one by one or together.
"""

from collections.abc import Callable, Sequence
from enum import IntEnum
from functools import cache
from statistics import NormalDist
from typing import Generic, TypeVar
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

Words = NDArray[np.uint64]
Floats = NDArray[np.float64]
Vectors = NDArray[np.complex128]
"""Planar vectors, x + iy, which are turned by multiplication."""
Draws = TypeVar("Draws")

_M0, _M1 = np.uint64(0xD2511F53), np.uint64(0xCD9E8D57)
_W0, _W1 = 0x9E3779B9, 0xBB67AE85
_LOW = np.uint64(0xFFFFFFFF)
_HALF = np.uint64(32)
_ROUNDS = 10
_NORMALS_PER_BLOCK = 4


class StreamId(IntEnum):
    """The use of a stream. The numbers never change, since recorded matches depend on them; 2, 3 and 4 are unused."""

    OWN = 1
    DRIFT = 5
    SEEN = 6
    BALL = 7
    AIR = 8
    OWN_LUCK = 9
    LEAVES = 10
    SENSOR = 11
    """Of all sensors in the table; the robot's name in the counter is followed by the sensor's and a use."""


def philox(counter: tuple[Words, Words, Words, Words], key: tuple[int, int]) -> tuple[Words, Words, Words, Words]:
    """Four random 32-bit words, in 64-bit integers, for each counter; the arrays of the counters are broadcast.

    Counters that are broadcast cost less than the same counters written out: the first rounds work on the small arrays,
    until every word differs.
    """
    c0, c1, c2, c3 = counter
    k0, k1 = key
    for _ in range(_ROUNDS):
        p0, p1 = _M0 * c0, _M1 * c2
        high0, high1 = p0 >> _HALF, p1 >> _HALF
        high0 ^= np.uint64(k1)
        high1 ^= np.uint64(k0)
        p0 &= _LOW
        p1 &= _LOW
        c0, c1, c2, c3 = _xor(high1, c1), p1, _xor(high0, c3), p0
        k0, k1 = (k0 + _W0) & 0xFFFFFFFF, (k1 + _W1) & 0xFFFFFFFF
    return c0, c1, c2, c3


def _xor(high: Words, word: Words) -> Words:
    """Exclusive or, in place where the shapes allow it: a new array costs as much as the operation."""
    return np.bitwise_xor(high, word, out=high if high.shape == word.shape else None)


BATCH = 256
"""Ticks or pictures for which draws are made at a time, where each takes dozens of numbers. The numbers do not depend
on it, but their cost does: each costs half as much again with 64, and no less with more than 256."""
SMALL_BATCH = 64
"""The same where each takes hundreds of numbers: a larger batch costs no less, and all of it falls into one tick."""


class BatchedDraws(Generic[Draws]):
    """Draws for every tick or picture, made for a whole batch when the first of it is needed."""

    def __init__(self, draw: Callable[[range], Sequence[Draws]], size: int = BATCH) -> None:
        self._draw = draw
        self._size = size
        self._batch = -1
        self._rows: Sequence[Draws] = ()

    def at(self, number: int) -> Draws:
        """The draws for one tick or picture."""
        batch, row = divmod(number, self._size)
        if batch != self._batch:
            self._rows = self._draw(range(batch * self._size, (batch + 1) * self._size))
            self._batch = batch
        return self._rows[row]


class RandomStreams:
    """All random numbers of a match."""

    def __init__(self, seed: int) -> None:
        self._key = (seed & 0xFFFFFFFF, seed >> 32 & 0xFFFFFFFF)

    def uniforms(self, stream: StreamId, robots: Sequence[str], ticks: Sequence[int], count: int) -> Floats:
        """Uniform numbers in (0, 1), shape (ticks, robots, count)."""
        blocks = -(-count // 4)
        index = np.arange(blocks, dtype=np.uint64)
        return self._uniforms(stream, robots, ticks, index).reshape(len(ticks), len(robots), blocks * 4)[:, :, :count]

    def normals(self, stream: StreamId, robots: Sequence[str], ticks: Sequence[int], count: int) -> Floats:
        """Standard normal numbers, shape (ticks, robots, count)."""
        blocks = -(-count // _NORMALS_PER_BLOCK)
        u = self.uniforms(stream, robots, ticks, blocks * 4).reshape(len(ticks), len(robots), blocks, 2, 2)
        return normal_pairs(u).reshape(len(ticks), len(robots), blocks * _NORMALS_PER_BLOCK)[:, :, :count]

    def errors(self, stream: StreamId, robots: Sequence[str], ticks: Sequence[int], count: int, lost: float) -> Floats:
        """Like `normals`, at a third of their cost: each number is one of `_quantiles`, a share `lost` of them NaN."""
        values = _quantiles()
        place = self.uniforms(stream, robots, ticks, count) * len(values)
        part = place.astype(np.intp)
        numbers: Floats = values.take(part)
        numbers[place - part < lost] = np.nan
        return numbers

    def pairwise_uniforms(
        self, stream: StreamId, robots: Sequence[str], others: Sequence[str], ticks: Sequence[int]
    ) -> Floats:
        """Four uniform numbers in (0, 1) for each robot and each other by name, shape (ticks, robots, others, 4)."""
        return self._uniforms(stream, robots, ticks, name_words(others))

    def uniforms_of_pairs(self, stream: StreamId, robots: Words, others: Words, tick: int) -> Floats:
        """Those of `pairwise_uniforms` for single pairs, whose names are given as `name_words`; shape (pairs, 4)."""
        now, kind = np.array([tick & 0xFFFFFFFF], dtype=np.uint64), np.array([int(stream)], dtype=np.uint64)
        return _as_uniforms(philox((others, robots, now, kind), self._key))

    def _uniforms(self, stream: StreamId, robots: Sequence[str], ticks: Sequence[int], index: Words) -> Floats:
        """Shape (ticks, robots, index, 4)."""
        tick = np.array(ticks, dtype=np.uint64)[:, None, None] & _LOW
        robot, kind = name_words(robots)[:, None], np.array(int(stream), dtype=np.uint64)
        return _as_uniforms(philox((index, robot, tick, kind), self._key))


def _as_uniforms(words: tuple[Words, Words, Words, Words]) -> Floats:
    """Four random words for each counter as uniform numbers in (0, 1), on a last axis."""
    uniform = np.empty((*words[0].shape, len(words)))
    for place, word in enumerate(words):
        uniform[..., place] = word
    uniform += 0.5
    uniform *= 2.0**-32
    return uniform


def normal_pairs(uniform: Floats) -> Floats:
    """Standard normal numbers from uniform numbers in (0, 1), in pairs on the last axis (Box–Muller transform)."""
    radius = np.sqrt(-2.0 * np.log(uniform[..., 0]))
    angle = 2.0 * np.pi * uniform[..., 1]
    pairs = np.empty(uniform.shape)
    np.multiply(radius, np.cos(angle), out=pairs[..., 0])
    np.multiply(radius, np.sin(angle), out=pairs[..., 1])
    return pairs


@cache
def _quantiles() -> Floats:
    """The middles of 2¹⁴ equally likely parts of the standard normal distribution; the last is 4.01."""
    return np.array([NormalDist().inv_cdf((part + 0.5) / 2**14) for part in range(2**14)])


def name_words(names: Sequence[str]) -> Words:
    """The words that stand for these names in the counters of streams."""
    return np.array([crc32(name.encode()) for name in names], dtype=np.uint64)
