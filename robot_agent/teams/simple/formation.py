"""The places of robots that do not play the ball, relative to it."""

import math

from robot_agent.skills.keep_off import inside, keep_off
from robot_agent.teams.simple.roles import Role
from schemas.config.sections import Pitch

CLEAR = 2.4
"""m between a robot and a ball that a teammate plays."""
WING = 0.25
"""Share of the pitch's width between its middle and a supporter."""
AHEAD = 2.0
"""m that supporters are ahead of the ball."""
GUARD = 0.45
"""Where the defender stands between the own goal and the ball, as a share."""
FARTHEST = 0.32
"""Distance of the defender from its goal at most, as a share of the pitch's length."""


def places(ball: tuple[float, float], pitch: Pitch, inset: float) -> list[tuple[Role, tuple[float, float]]]:
    """The places of the formation, the most important first; all of them outside the penalty areas."""
    front = pitch.goal_line - pitch.penalty_area_depth - inset
    ahead = max(-front, min(front, ball[0] + AHEAD))
    wing = WING * pitch.width
    wanted = (
        (Role.DEFENDER, _guard(ball, pitch, front)),
        (Role.LEFT, (ahead, wing)),
        (Role.RIGHT, (ahead, -wing)),
    )
    return [(role, keep_off(x, y, ball, CLEAR, pitch, inset)) for role, (x, y) in wanted]


def _guard(ball: tuple[float, float], pitch: Pitch, front: float) -> tuple[float, float]:
    """The defender's place between the own goal and the ball."""
    dx, dy = ball[0] + pitch.goal_line, ball[1]
    share = min(GUARD, FARTHEST * pitch.length / max(math.hypot(dx, dy), 1e-6))
    x, y = inside(share * dx - pitch.goal_line, share * dy, pitch, 0.0)
    return max(-front, x), y
