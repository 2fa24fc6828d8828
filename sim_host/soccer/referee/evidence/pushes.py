"""Pushes: robots of different sides that lean on each other, with the duration and the distance of the push.

The engine reports the contacts. One robot pushes the other as far as both move along the line between their centres.
"""

import math
from typing import NamedTuple

from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.match_constants import MatchConstants

GAP = 0.2
"""s; two robots without contact for this long have separated."""


class Push(NamedTuple):
    """Two robots by their indices in the roster, the smaller index first."""

    first: int
    second: int
    lasted: float = 0.0
    """s."""
    way: float = 0.0
    """m that the first has pushed the second; negative if the second has pushed the first."""
    gap: float = 0.0
    """s since they last touched."""


def pushes_after(match: MatchConstants, before: tuple[Push, ...], snapshot: Snapshot, dt: float) -> tuple[Push, ...]:
    """The pushes after one more tick of `dt` in s, in the order of the roster."""
    sides = match.roster.sides
    known = {(push.first, push.second): push for push in before}
    touching = [pair for pair in snapshot.contacts if sides[pair[0]] is not sides[pair[1]]]
    now = []
    for pair in sorted({**known, **dict.fromkeys(touching)}):
        push = known.get(pair, Push(*pair))
        if pair in touching:
            way = push.way + _pushed(snapshot, *pair) * dt
            now.append(push._replace(lasted=push.lasted + push.gap + dt, way=way, gap=0.0))
        elif push.gap + dt < GAP:
            now.append(push._replace(gap=push.gap + dt))
    return tuple(now)


def _pushed(snapshot: Snapshot, first: int, second: int) -> float:
    """m/s at which both move along the line from the first to the second; 0 if they move in opposite directions."""
    a, b = snapshot.robots[first], snapshot.robots[second]
    dx, dy = b.x - a.x, b.y - a.y
    away = math.hypot(dx, dy)
    if away < 1e-6:
        return 0.0
    va, vb = (a.vx * dx + a.vy * dy) / away, (b.vx * dx + b.vy * dy) / away
    if va * vb <= 0.0:
        return 0.0
    return min(va, vb) if va > 0.0 else max(va, vb)
