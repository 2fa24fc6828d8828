"""A contest: a ball that both sides are at, with its duration and progress."""

import math
from typing import NamedTuple

from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.evidence.zones import Zones
from sim_host.soccer.referee.match_constants import MatchConstants

GAP = 0.5
"""s; a contest ends when one side has been away from the ball for longer."""


class Contest(NamedTuple):
    """Robots of both sides within reach of the ball."""

    place: tuple[float, float]
    """m; place of the ball when it last made progress."""
    stuck: float = 0.0
    """s since the ball last made progress."""
    lasted: float = 0.0
    """s since the contest began."""
    gap: float = 0.0
    """s since both sides were last at the ball."""
    robots: tuple[int, ...] = ()
    """Robots that are, or last were, at the ball while both sides were, by their indices in the roster."""


def contest_after(
    match: MatchConstants, before: Contest | None, zones: Zones, snapshot: Snapshot, dt: float
) -> Contest | None:
    """The contest after one more tick of `dt` in s, or None."""
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
