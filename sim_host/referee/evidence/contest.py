"""A ball that both sides are at: since when, and how far it has come meanwhile."""

import math
from typing import NamedTuple

from sim_host.referee.evidence.zones import Zones
from sim_host.referee.match_constants import MatchConstants
from sim_host.snapshot import Snapshot

GAP = 0.5
"""s for which one side may leave the ball before the contest is over."""


class Contest(NamedTuple):
    """Robots of both sides within reach of the ball."""

    place: tuple[float, float]
    """m; where the ball was when it last made progress."""
    stuck: float = 0.0
    """s since the ball last made progress."""
    lasted: float = 0.0
    """s since both sides have been at the ball."""
    gap: float = 0.0
    """s since both sides were at it last."""
    robots: tuple[int, ...] = ()
    """Who is or was at it last, by their indices in the roster."""


def contest_after(
    match: MatchConstants, before: Contest | None, zones: Zones, snapshot: Snapshot, dt: float
) -> Contest | None:
    """The contest after one more tick of `dt` in s, or nothing."""
    sides, ball = match.roster.sides, snapshot.ball
    near = zones.near
    both = len(near) > 1 and len({sides[index] for index in near}) > 1
    place = (ball.x, ball.y)
    if before is None:
        return Contest(place, robots=zones.near) if both else None
    gap = 0.0 if both else before.gap + dt
    if gap > GAP:
        return None
    moved_on = math.dist(place, before.place) > match.book.scrum.progress
    return Contest(
        place=place if moved_on else before.place,
        stuck=0.0 if moved_on else before.stuck + dt,
        lasted=before.lasted + dt,
        gap=gap,
        robots=zones.near if both else before.robots,
    )
