"""Progress of the ball in play: since when it has been within a circle around a place.

The circle is around the place of a catch, or of a ball that no robot has caught. Only a ball that leaves the circle
makes progress: neither a release followed by another catch inside, nor a pass to a teammate inside, nor a touch.
"""

import math
from typing import NamedTuple

from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.evidence.dribble import Dribble
from sim_host.soccer.referee.match_constants import MatchConstants


class Progress(NamedTuple):
    """The circle that the ball has to leave."""

    place: tuple[float, float]
    """m; its centre."""
    since: float
    """s; simulated time from which on the ball has been inside."""
    caught: bool
    """A robot has caught the ball inside."""


def progress_after(
    match: MatchConstants, before: Progress | None, dribble: Dribble | None, snapshot: Snapshot
) -> Progress:
    """The progress after one more tick in play."""
    radius = match.book.stall.progress_distance
    place = (snapshot.ball.x, snapshot.ball.y)
    if before is None or math.dist(before.place, place) > radius:
        caught = dribble is not None
        if dribble is not None and math.dist(dribble.caught, place) <= radius:
            place = dribble.caught
        return Progress(place, snapshot.time, caught)
    if dribble is not None and not before.caught:
        return Progress(dribble.caught, snapshot.time, True)
    return before
