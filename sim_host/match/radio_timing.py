"""When radio messages leave their robots, how long they take, and which of them are lost.

Times are in control ticks, as fractions where a model has them: 7.25 is a quarter of a tick after the sights of tick 7.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from schemas.config.sections import RadioChannel
from schemas.side import Side
from sim_host.sensing.random_streams import BATCH, SMALL_BATCH, BatchedDraws, Floats, RandomStreams, StreamId
from sim_host.snapshot import Roster

Ticks = NDArray[np.int64]
NEVER = 2**62
"""In place of a tick: the message does not arrive."""
_ROUNDING = 1e-6
"""Ticks; in whole ticks, a delay that exceeds a whole number by no more than this is that number: floats round."""
_MANY = 12
"""Robots of a side, from which on draws are made in small batches: their number grows with the square."""


class Flights(NamedTuple):
    """The draws for all messages of one tick."""

    leaves: list[float]
    """Per sender: ticks from the sight that its message answers until the message leaves."""
    flights: Floats
    """Ticks from leaving to arrival, receiver × sender; infinite where the message is lost or not for this receiver."""
    arrives: Ticks
    """The first tick whose sights have the message, receiver × sender, if no channel delays it; or `NEVER`."""


def arrival_ticks(times: Floats) -> Ticks:
    """The first tick at or after each time; `NEVER` for an infinite one."""
    return np.minimum(np.ceil(times), float(NEVER)).astype(np.int64)


class RadioTiming:
    """Draws the times of all messages. Each draw depends on its robots' names, the tick and the seed alone."""

    def __init__(self, air: RadioChannel, roster: Roster, tick: float, streams: RandomStreams) -> None:
        self._air = air
        self._tick_s = tick
        self._streams = streams
        self._names = roster.names
        self._sides = [[index for index, its in enumerate(roster.sides) if its is side] for side in Side]
        largest = max(map(len, self._sides))
        self._draws = BatchedDraws(self._draw, SMALL_BATCH if largest >= _MANY else BATCH)

    def at(self, tick: int) -> Flights:
        """The draws for messages that answer the sights of the tick before, and that this tick's sights can have."""
        return self._draws.at(tick)

    def _draw(self, ticks: range) -> list[Flights]:
        air, count = self._air, len(self._names)
        flights = np.full((len(ticks), count, count), np.inf)
        for members in self._sides:
            flights[np.ix_(range(len(ticks)), members, members)] = self._flights_within(members, ticks)
        leaves = self._leaves(ticks)
        number = np.array(ticks)[:, None, None]
        if air.model == "ticks":
            flights = np.ceil(flights - _ROUNDING)
            arrives = arrival_ticks(number + flights)
        else:
            arrives = arrival_ticks(number - 1 + leaves[:, None, :] + flights)
        return list(map(Flights, leaves.tolist(), flights, arrives))

    def _leaves(self, ticks: range) -> Floats:
        """Ticks until the messages leave, (ticks, senders): a tick in whole ticks, else at any time within the tick."""
        if self._air.model == "ticks":
            return np.ones((len(ticks), len(self._names)))
        return self._streams.uniforms(StreamId.LEAVES, self._names, ticks, 1)[..., 0]

    def _flights_within(self, members: Sequence[int], ticks: range) -> Floats:
        """Ticks from leaving to arrival between the members of a team, (ticks, receivers, senders)."""
        air, names = self._air, [self._names[index] for index in members]
        drawn = self._streams.pairwise_uniforms(StreamId.AIR, names, names, ticks).transpose(0, 2, 1, 3)
        flights = (air.delay + drawn[..., 1] * air.jitter) / self._tick_s
        flights[drawn[..., 0] < air.loss] = np.inf
        flights[:, range(len(names)), range(len(names))] = np.inf
        return flights
