"""The penalty and goal areas; `end` is the sign of the x of the goal that an area belongs to."""

from schemas.config.sections import Pitch


def in_penalty_area(pitch: Pitch, end: int, x: float, y: float, margin: float = 0.0) -> bool:
    """Whether a point in m is in the penalty area of that end, extended by `margin` in m, or in the goal behind it."""
    depth, width = pitch.penalty_area_depth, pitch.penalty_area_width
    far = x * end
    return (
        far > pitch.goal_line - depth - margin
        and abs(y) < width / 2 + margin
        and (far <= pitch.goal_line + margin or _in_goal(pitch, far, y))
    )


def in_goal_area(pitch: Pitch, end: int, x: float, y: float) -> bool:
    """Whether a point in m is in the goal area of that end, or in the goal behind it."""
    far = x * end
    return (
        far > pitch.goal_line - pitch.goal_area_depth
        and abs(y) < pitch.goal_area_width / 2
        and (far <= pitch.goal_line or _in_goal(pitch, far, y))
    )


def _in_goal(pitch: Pitch, far: float, y: float) -> bool:
    """Whether a point is behind the goal line between the posts; `far` is its x toward that goal."""
    return pitch.goal_line < far <= pitch.goal_line + pitch.goal_depth and abs(y) < pitch.goal_width / 2


def in_a_penalty_area(pitch: Pitch, x: float, y: float) -> bool:
    """Whether a point in m is in either penalty area."""
    return in_penalty_area(pitch, 1 if x > 0 else -1, x, y)
