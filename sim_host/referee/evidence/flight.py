"""The last kick: from where, how high the ball rose, and where it came down.

It lasts until somebody touches the ball; a ball that rose and comes down has landed in that tick.
"""

from typing import NamedTuple

from sim_host.referee.match_constants import MatchConstants
from sim_host.snapshot import Snapshot

AIR = 0.05
"""m below the ball; with more it has left the ground, with less it has come down again."""


class Flight(NamedTuple):
    """A kicked ball that nobody has touched since."""

    robot: str
    kicked_from: tuple[float, float]
    """m; the centre of the robot at the kick."""
    time: float
    """s; simulated time of the kick."""
    apex: float = 0.0
    """m; the highest that the underside of the ball has been above the ground."""
    landed: tuple[float, float] | None = None
    """m; where it came down first."""
    just_landed: bool = False
    """In this tick."""


def flight_after(match: MatchConstants, before: Flight | None, snapshot: Snapshot) -> Flight | None:
    """The kick after one more tick, or nothing."""
    kicker = snapshot.kicked
    if kicker is not None:
        robot = snapshot.robots[match.roster.names.index(kicker)]
        if any(name != kicker for name in snapshot.touches[snapshot.touches.index(kicker) :]):
            return None
        return Flight(kicker, (robot.x, robot.y), snapshot.time, _air(match, snapshot))
    if before is None or snapshot.touches:
        return None
    if before.landed is not None:
        return before._replace(just_landed=False) if before.just_landed else before
    air = _air(match, snapshot)
    if air > before.apex:
        return before._replace(apex=air)
    if before.apex > AIR >= air:
        return before._replace(landed=(snapshot.ball.x, snapshot.ball.y), just_landed=True)
    return before


def _air(match: MatchConstants, snapshot: Snapshot) -> float:
    return max(0.0, snapshot.ball.z - match.ball.radius)
