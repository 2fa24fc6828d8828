"""What a robot shows its authors over the field: role, place, the pass and the shot it aims at, and what it weighed."""

from collections.abc import Mapping, Sequence

from robot_agent.sdk.bodies import Body
from robot_agent.teams.reference.passing import Pass
from schemas.frames import Point
from schemas.messages.debug import Debug, DebugCircle, DebugLine, DebugPoint, DebugText

_PLACE, _PASS, _OPPONENT = "cyan", "lime", "red"
_BESIDE = 0.45
"""m from the robot's centre to its text."""


def drawing(
    me: Body,
    role: str,
    intention: str,
    *,
    place: Point | None,
    aimed: Pass | None,
    weighed: Mapping[str, float],
    opponents: Sequence[Point],
) -> Debug:
    """The drawing of one tick.

    Args:
        place: where the robot is to stand.
        aimed: the pass that it aims at.
        weighed: value of each choice of the robot with the ball.
        opponents: where it believes opponents to be.
    """
    lines = []
    if place is not None:
        lines.append(DebugLine(x1=me.x, y1=me.y, x2=place[0], y2=place[1], colour=_PLACE))
    if aimed is not None:
        lines.append(DebugLine(x1=me.x, y1=me.y, x2=aimed.target[0], y2=aimed.target[1], colour=_PASS))
    return Debug(
        values={"role": role, "intention": intention} | {name: round(value, 2) for name, value in weighed.items()},
        points=[DebugPoint(x=place[0], y=place[1], colour=_PLACE)] if place is not None else [],
        lines=lines,
        circles=[DebugCircle(x=x, y=y, radius=0.3, colour=_OPPONENT) for x, y in opponents],
        texts=[DebugText(x=me.x, y=me.y - _BESIDE, text=f"{role}: {intention}" if intention else role)],
    )
