"""The flight of the last kick: its origin, its apex, and where the ball came down.

It ends when a robot touches the ball. A ball that has risen lands in the tick in which it is down again.
"""

from typing import NamedTuple

from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.match_constants import MatchConstants

AIR = 0.05
"""m of air below the ball; with more it has left the ground, with less it is down again."""


class Flight(NamedTuple):
    """A kicked ball that no robot has touched since."""

    robot: str
    kicked_from: tuple[float, float]
    """m; the centre of the robot at the kick."""
    time: float
    """s; simulated time of the kick."""
    apex: float = 0.0
    """m; greatest height of the underside of the ball above the ground."""
    landed: tuple[float, float] | None = None
    """m; place where it first came down."""
    just_landed: bool = False
    """It came down in this tick."""


def flight_after(match: MatchConstants, before: Flight | None, snapshot: Snapshot) -> Flight | None:
    """The flight after one more tick, or None."""
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
