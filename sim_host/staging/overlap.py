"""Overlap of bodies: discs and blocks on the ground, each with the heights between which it extends."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from schemas.config.sections import Pitch
from schemas.frames import rotate
from sim_host.physics.pitch import goals

MAX_OVERLAP = 0.02
"""m; the engine pushes bodies apart gently from this depth, and a held ball lies a little inside the hull."""


@dataclass(frozen=True, slots=True)
class Disc:
    """A robot, the ball, or a round obstacle: m, field frame."""

    name: str
    x: float
    y: float
    radius: float
    bottom: float
    top: float
    core: float | None = None
    """m; radius of a robot's hull without its frame: the ball may come this near to its axis."""
    is_ball: bool = False


@dataclass(frozen=True, slots=True)
class Block:
    """A box-shaped obstacle or a part of a goal: m, rad, field frame."""

    name: str
    x: float
    y: float
    heading: float
    half_x: float
    half_y: float
    bottom: float
    top: float


Body = Disc | Block


def goal_blocks(pitch: Pitch) -> list[Block]:
    """Frames and nets of both goals."""
    boxes = [box for goal in goals(pitch) for box in (*goal.frame, *goal.net)]
    return [
        Block("a goal", box.x, box.y, 0.0, box.half_x, box.half_y, box.z - box.half_z, box.z + box.half_z)
        for box in boxes
    ]


def why_outside(pitch: Pitch, body: Body) -> str | None:
    """Why a body is not within the boundary, or None."""
    half_x, half_y = _extents(body)
    x, y = pitch.goal_line + pitch.border - half_x, pitch.touch_line + pitch.border - half_y
    if abs(body.x) <= x + MAX_OVERLAP and abs(body.y) <= y + MAX_OVERLAP:
        return None
    return (
        f"{body.name} would be at ({body.x:g}, {body.y:g}), beyond the boundary; "
        f"|x| is at most {x:.2f} m, |y| at most {y:.2f} m"
    )


def _extents(body: Body) -> tuple[float, float]:
    """How far a body reaches from its centre along x and y, in m."""
    if isinstance(body, Disc):
        return body.radius, body.radius
    c, s = abs(math.cos(body.heading)), abs(math.sin(body.heading))
    return c * body.half_x + s * body.half_y, s * body.half_x + c * body.half_y


def why_overlapping(body: Disc, others: Iterable[Body]) -> str | None:
    """Why a body overlaps one of the others, or None."""
    for other in others:
        depth = overlap(body, other)
        if depth > MAX_OVERLAP:
            at = f"({body.x:g}, {body.y:g})"
            return f"{body.name} at {at} would be {depth:.2f} m inside {other.name}; choose another place"
    return None


def overlap(body: Disc, other: Body) -> float:
    """Depth in m to which a body overlaps another on the ground; negative if there is a gap, or if one is above."""
    if body.bottom >= other.top or other.bottom >= body.top:
        return -math.inf
    if isinstance(other, Disc):
        apart = math.hypot(body.x - other.x, body.y - other.y)
        return _hull_distance(body, other) + _hull_distance(other, body) - apart
    along, across = rotate(body.x - other.x, body.y - other.y, -other.heading)
    away_x, away_y = abs(along) - other.half_x, abs(across) - other.half_y
    if away_x <= 0.0 and away_y <= 0.0:
        return body.radius - max(away_x, away_y)
    return body.radius - math.hypot(max(away_x, 0.0), max(away_y, 0.0))


def _hull_distance(body: Disc, other: Disc) -> float:
    """m from the axis of a body to its hull on the side of the other body."""
    return body.radius if body.core is None or not other.is_ball else body.core
