"""Set pieces of our own: whom the taker plays to, and when. Against us, the formation's places are made legal."""

import math
from collections.abc import Mapping, Sequence

from robot_agent.bodies import Body
from robot_agent.teams.reference.parameters import Parameters
from robot_agent.teams.reference.passing import Pass, passes
from schemas.config.sections import Pitch

Point = tuple[float, float]

KICK_OFF_TO = (0.8, 3.0)
"""m; target of a kick-off: ahead, so that the taker waits behind the ball in its own half."""
KICK_OFF_ARRIVING = 1.0
"""m/s on arrival; the ball waits there for its receiver, which stands in its own half until START."""


def kick_off(mates: Mapping[str, Body]) -> Pass | None:
    """The kick-off: to the teammate that is nearest to the target or to its mirror image; None without teammates."""
    x, y = KICK_OFF_TO
    ways = [(math.dist(body[:2], (x, side * y)), name, side) for name, body in mates.items() for side in (1.0, -1.0)]
    _, name, side = min(ways, default=(0.0, "", 1.0))
    return Pass(name, (x, side * y), 1.0, 0.0) if name else None


def best_restart(
    spot: Point,
    mates: Mapping[str, Body],
    opponents: Sequence[Point],
    chosen: tuple[str, Point] | None,
    waited: float,
    pitch: Pitch,
    parameters: Parameters,
) -> Pass | None:
    """The pass that is played, once one is sure enough or the time is up; None to wait.

    Args:
        waited: s since START.
    """
    toward = math.atan2(-spot[1], -spot[0])
    found = passes(spot, toward, mates, opponents, chosen, pitch, parameters)
    best = max(found, key=lambda one: one.chance + one.value, default=None)
    if best is None or (best.chance < parameters.restart_sure and waited < parameters.restart_wait):
        return None
    return best
