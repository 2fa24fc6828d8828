"""Counter-based random streams: a number depends on (seed, what, robot, tick, index) and on nothing else.

Philox4x32-10 (Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11), vectorised.
There is no state: a draw that is left out shifts no other, any tick can be drawn first, and many at once.
"""

from collections.abc import Callable, Sequence
from enum import IntEnum
from typing import Generic, TypeVar
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

Words = NDArray[np.uint64]
Floats = NDArray[np.float64]
Vectors = NDArray[np.complex128]
"""Planar vectors, x + iy: turning is multiplying."""
Draws = TypeVar("Draws")

_M0, _M1 = np.uint64(0xD2511F53), np.uint64(0xCD9E8D57)
_W0, _W1 = 0x9E3779B9, 0xBB67AE85
_LOW = np.uint64(0xFFFFFFFF)
_HALF = np.uint64(32)
_ROUNDS = 10
_NORMALS_PER_BLOCK = 4


class StreamId(IntEnum):
    """What a stream is for; the numbers are part of every recording's meaning and never change.

    2, 3 and 4 were the ball, the obstacles and the radio, drawn by place in the roster.
    """

    OWN = 1
    DRIFT = 5
    SEEN = 6
    BALL = 7
    AIR = 8
    OWN_LUCK = 9


def philox(counter: tuple[Words, Words, Words, Words], key: tuple[int, int]) -> tuple[Words, Words, Words, Words]:
    """Four 32-bit words of randomness for each counter, whose arrays are broadcast; 32-bit values in 64-bit words.

    Counters that are made of few words each way cost less than as many that are written out: the first rounds mix one
    axis with the next, and only then is every word another.
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
    """Both, exclusively or; in place where that is possible: a new array costs as much as what is done to it."""
    return np.bitwise_xor(high, word, out=high if high.shape == word.shape else None)


BATCH = 256
"""Draws are made for this many ticks or pictures at a time, where one takes dozens of numbers. The numbers are the
same, the cost of each is not: with 64 it is half as much again, with more it falls no further."""
SMALL_BATCH = 64
"""The same where one takes hundreds: more at once cost as much, and all of it in one tick."""


class BatchedDraws(Generic[Draws]):
    """Draws of one kind for every tick or picture, made for many at once when the first of them is asked for."""

    def __init__(self, draw: Callable[[range], Sequence[Draws]], size: int = BATCH) -> None:
        self._draw = draw
        self._size = size
        self._batch = -1
        self._rows: Sequence[Draws] = ()

    def at(self, number: int) -> Draws:
        """The draws of one, of those that `draw` makes for each."""
        batch, row = divmod(number, self._size)
        if batch != self._batch:
            self._rows = self._draw(range(batch * self._size, (batch + 1) * self._size))
            self._batch = batch
        return self._rows[row]


class RandomStreams:
    """All randomness of a match."""

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

    def pairwise_uniforms(
        self, stream: StreamId, robots: Sequence[str], others: Sequence[str], ticks: Sequence[int]
    ) -> Floats:
        """Four uniform numbers in (0, 1) for each robot and each other by name, shape (ticks, robots, others, 4)."""
        return self._uniforms(stream, robots, ticks, _crc_of(others))

    def _uniforms(self, stream: StreamId, robots: Sequence[str], ticks: Sequence[int], index: Words) -> Floats:
        """Shape (ticks, robots, index, 4)."""
        tick = np.array(ticks, dtype=np.uint64)[:, None, None] & _LOW
        robot, kind = _crc_of(robots)[:, None], np.array(int(stream), dtype=np.uint64)
        uniform = np.empty((len(ticks), len(robots), len(index), 4))
        for place, word in enumerate(philox((index, robot, tick, kind), self._key)):
            uniform[..., place] = word
        uniform += 0.5
        uniform *= 2.0**-32
        return uniform


def normal_pairs(uniform: Floats) -> Floats:
    """Standard normal numbers from as many uniform ones in (0, 1), two by two on the last axis (Box and Muller)."""
    radius = np.sqrt(-2.0 * np.log(uniform[..., 0]))
    angle = 2.0 * np.pi * uniform[..., 1]
    pairs = np.empty(uniform.shape)
    np.multiply(radius, np.cos(angle), out=pairs[..., 0])
    np.multiply(radius, np.sin(angle), out=pairs[..., 1])
    return pairs


def _crc_of(names: Sequence[str]) -> Words:
    return np.array([crc32(name.encode()) for name in names], dtype=np.uint64)
