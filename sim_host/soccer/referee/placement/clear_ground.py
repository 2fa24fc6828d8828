"""Ground that is clear of obstacles: the place of the ball when an obstacle stands on its spot.

The ball is placed at the nearest free place: along the halfway line at a kick-off, at the same distance from the goal
at a penalty, so that neither side gains, along the touch line at a throw-in, otherwise in any direction. It stays
inside the lines, and out of penalty areas that it was not in. If possible, a robot has room on every side of it.
"""

import math
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Final

from schemas.config.obstacle import Shape
from schemas.config.sections import Pitch
from schemas.frames import rotate
from schemas.soccer.game import Phase
from sim_host.snapshot import ObstacleState, Snapshot
from sim_host.soccer.referee.areas import in_a_penalty_area
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.restart import Restart, Spot
from sim_host.soccer.referee.match_constants import MatchConstants

_TOUCHES = 0.02
"""m that the ball may overlap a hull when it is placed; the engine pushes it out gently."""
_STEP = 0.05
"""m between two places that are tried."""
_FARTHEST = 8.0
"""m; greatest distance from the spot that is tried."""
_BEARINGS = 32
"""Number of directions that are tried if any direction is allowed."""

_ALONG_Y: Final = (math.pi / 2, -math.pi / 2)
_ALONG_X: Final = (0.0, math.pi)
_LINES: Mapping[Phase, tuple[float, ...]] = {
    Phase.KICK_OFF: _ALONG_Y,
    Phase.PENALTY: _ALONG_Y,
    Phase.THROW_IN: _ALONG_X,
}
"""Restart → the bearings along which its spot is moved if possible, rad, as the restart's side sees the field."""


def clear_restart(match: MatchConstants, state: RefereeState, snapshot: Snapshot, restart: Restart) -> Restart:
    """The restart, moved to the nearest spot without an obstacle if necessary.

    Of two equally near spots it is the one that comes first as the restart's side sees the field, and at a drop ball
    the side that kicked off this half (ours).
    """
    if has_room(match, snapshot, restart.spot):
        return restart
    forward = math.pi if state.attack(restart.side or state.kick_off) < 0 else 0.0
    spot = _clear_spot(
        match.pitch,
        match.book.restarts.field_inset,
        (match.ball.radius + 2.0 * max(match.reaches, default=0.0), match.ball.radius),
        snapshot.obstacles,
        restart.spot,
        tuple([bearing + forward for bearing in _LINES.get(restart.phase, ())]),
        forward,
    )
    return restart._replace(spot=spot)


def has_room(match: MatchConstants, snapshot: Snapshot, spot: Spot) -> bool:
    """Whether obstacles leave room for the ball at a spot."""
    return clearance(snapshot.obstacles, spot) >= match.ball.radius - _TOUCHES


def clearance(obstacles: tuple[ObstacleState, ...], spot: Spot) -> float:
    """m between a point on the ground and the nearest obstacle; 0 or less on an obstacle, infinite without any."""
    return min((_to_hull(obstacle, spot) for obstacle in obstacles), default=math.inf)


@lru_cache(8)
def _clear_spot(
    pitch: Pitch,
    inset: float,
    rooms: tuple[float, ...],
    obstacles: tuple[ObstacleState, ...],
    spot: Spot,
    lines: tuple[float, ...],
    forward: float,
) -> Spot:
    """The nearest legal place with the first of these rooms that any has, in m; the spot itself if none has.

    Cached: obstacles rarely move, a search without success takes longer than a tick, and it is repeated in each tick.
    """
    for room in rooms:
        for bearings in (lines, _all_bearings(spot, forward)):
            for place in _around(pitch, inset, spot, bearings):
                if clearance(obstacles, place) >= room:
                    return place
    return spot


def _to_hull(obstacle: ObstacleState, spot: Spot) -> float:
    x, y = spot[0] - obstacle.x, spot[1] - obstacle.y
    if obstacle.shape is Shape.CYLINDER:
        return math.hypot(x, y) - obstacle.radius
    along, across = rotate(x, y, -obstacle.heading)
    away_x, away_y = abs(along) - obstacle.size_x / 2, abs(across) - obstacle.size_y / 2
    return math.hypot(max(away_x, 0.0), max(away_y, 0.0))


def _all_bearings(spot: Spot, forward: float) -> tuple[float, ...]:
    """All bearings, beginning with the one toward the centre of the field, alternately to both sides.

    From the centre itself, they begin with `forward`.
    """
    inward = math.atan2(-spot[1], -spot[0]) if spot != (0.0, 0.0) else forward
    turns = [(step + 1) // 2 * (1 if step % 2 else -1) for step in range(_BEARINGS)]
    return tuple([inward + turn * math.tau / _BEARINGS for turn in turns])


def _around(pitch: Pitch, inset: float, spot: Spot, bearings: tuple[float, ...]) -> Iterator[Spot]:
    """Legal places of the ball around a spot, the nearest first."""
    most_x, most_y = max(abs(spot[0]), pitch.goal_line - inset), max(abs(spot[1]), pitch.touch_line - inset)
    was_in_area = in_a_penalty_area(pitch, *spot)
    for ring in range(1, round(_FARTHEST / _STEP) + 1):
        for bearing in bearings:
            x = round(spot[0] + ring * _STEP * math.cos(bearing), 6)
            y = round(spot[1] + ring * _STEP * math.sin(bearing), 6)
            if abs(x) <= most_x and abs(y) <= most_y and (was_in_area or not in_a_penalty_area(pitch, x, y)):
                yield x, y
