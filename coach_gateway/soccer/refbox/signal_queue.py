"""The signals of a box that wait to be forwarded, in their order; of too many the oldest are dropped."""

import asyncio
from collections import deque
from typing import NamedTuple

from schemas.messages.soccer.league.signals import Signal
from schemas.side import Side

MOST_WAITING = 500
"""Signals that wait until the match can be officiated; beyond them, the oldest are dropped."""


class BoxSignal(NamedTuple):
    """One signal of the box."""

    signal: Signal
    side: Side | None
    number: int | None
    """Number of the robot that it names."""

    @property
    def changes_game(self) -> bool:
        """Whether it changes what is being played; cards, repairs and names of halves do not."""
        return self.signal.phase is not None or self.signal.goals != 0


class SignalQueue:
    """A queue with one reader."""

    def __init__(self) -> None:
        self._waiting: deque[BoxSignal] = deque()
        self._filled = asyncio.Event()

    def put(self, signal: BoxSignal) -> bool:
        """Add a signal; returns whether an older one was dropped for it."""
        self._waiting.append(signal)
        self._filled.set()
        full = len(self._waiting) > MOST_WAITING
        if full:
            self._waiting.popleft()
        return full

    async def next(self) -> BoxSignal:
        """The oldest signal, as soon as there is one."""
        await self._filled.wait()
        signal = self._waiting.popleft()
        if not self._waiting:
            self._filled.clear()
        return signal

    @property
    def changes_game(self) -> bool:
        """Whether a signal is waiting that changes what is being played."""
        return any(signal.changes_game for signal in self._waiting)
