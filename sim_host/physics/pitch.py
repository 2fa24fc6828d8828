"""The fixed bodies of a pitch as boxes: goals, and the boundary around the border."""

from typing import NamedTuple

from schemas.config.sections import Pitch

_WALL = 0.2
"""m, thickness of the boundary and of the net boxes' walls: thicker than a fast ball travels in one step."""


class Box(NamedTuple):
    """An upright box: centre and half extents, m."""

    x: float
    y: float
    z: float
    half_x: float
    half_y: float
    half_z: float


class Furniture(NamedTuple):
    """What a game has on its floor besides robots and obstacles."""

    ball: bool = True
    goals: bool = True


SOCCER = Furniture()


def boundary(pitch: Pitch) -> list[Box]:
    """Four walls around the border."""
    out_x = pitch.goal_line + pitch.border + _WALL / 2
    out_y = pitch.touch_line + pitch.border + _WALL / 2
    half_z = pitch.boundary_height / 2
    ends = [Box(sign * out_x, 0.0, half_z, _WALL / 2, out_y + _WALL / 2, half_z) for sign in (1, -1)]
    sides = [Box(0.0, sign * out_y, half_z, out_x + _WALL / 2, _WALL / 2, half_z) for sign in (1, -1)]
    return ends + sides


def fixed_boxes(pitch: Pitch, furniture: Furniture) -> list[Box]:
    """Everything of a pitch that robots can run into."""
    both = goals(pitch) if furniture.goals else []
    return [*boundary(pitch), *(box for goal in both for box in (*goal.frame, *goal.net))]


class Goal(NamedTuple):
    """One goal: the hard frame, and the net box behind it that a ball enters and rests in."""

    frame: list[Box]
    net: list[Box]


def goals(pitch: Pitch) -> list[Goal]:
    """Both goals; the frame's front stands on the outer edge of the goal line."""
    return [_goal(pitch, sign) for sign in (1, -1)]


def _goal(pitch: Pitch, sign: int) -> Goal:
    post, width, height, depth = pitch.post / 2, pitch.goal_width / 2, pitch.goal_height, pitch.goal_depth
    front = pitch.goal_line + post
    top = height + pitch.post
    posts = [Box(sign * front, side * (width + post), top / 2, post, post, top / 2) for side in (1, -1)]
    bar = Box(sign * front, 0.0, height + post, post, width + pitch.post, post)
    behind = (depth - pitch.post) / 2
    middle = pitch.goal_line + pitch.post + behind
    thick = _WALL / 2
    sides = [Box(sign * middle, side * (width + thick), top / 2, behind, thick, top / 2) for side in (1, -1)]
    back = Box(sign * (pitch.goal_line + depth + thick), 0.0, top / 2, thick, width + _WALL, top / 2)
    roof = Box(sign * middle, 0.0, height + thick, behind, width, thick)
    return Goal(frame=[*posts, bar], net=[*sides, back, roof])
