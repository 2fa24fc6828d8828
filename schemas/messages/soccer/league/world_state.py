"""A team's world state in the format of the league's referee box, made from values of the field frame.

`world_state` returns the object of the league's JSON: m, m/s and rad, in the team's axes.
"""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from schemas.messages.soccer.league.axes import heading_across, vector_to_log
from schemas.messages.world import World
from schemas.side import Side

_DIGITS = 3
"""Decimal places, as in the description of the format: mm and mrad."""
FULL = 100.0
"""Battery level in percent; the battery of a simulated robot does not run out."""


class RobotSeen(NamedTuple):
    """One of the team's robots: number, pose in m and rad, velocity in m/s and rad/s, in the field frame."""

    number: int
    x: float
    y: float
    heading: float
    vx: float
    vy: float
    omega: float
    holding: bool
    intention: str = ""


class BallSeen(NamedTuple):
    """A ball: centre in m, velocity in m/s, in the field frame; confidence of the team from 0 to 1."""

    x: float
    y: float
    z: float
    vx: float
    vy: float
    vz: float
    confidence: float = 1.0


class ObstacleSeen(NamedTuple):
    """An obstacle: centre in m, velocity in m/s, in the field frame; radius in m; confidence from 0 to 1."""

    x: float
    y: float
    vx: float
    vy: float
    radius: float
    confidence: float = 1.0


def world_state(
    team: str,
    attack: int,
    robots: Iterable[RobotSeen],
    balls: Iterable[BallSeen],
    obstacles: Iterable[ObstacleSeen],
    *,
    age_ms: int = 0,
) -> dict[str, Any]:
    """The world state of the team of that name, which attacks `attack` (+1 or −1) along x.

    Target poses, which the schema requires, are not known; each robot's own pose takes their place.
    """
    return {
        "type": "worldstate",
        "teamName": team,
        "intention": "",
        "robots": [_robot(robot, attack) for robot in robots],
        "balls": [_ball(ball, attack) for ball in balls],
        "obstacles": [_obstacle(obstacle, attack) for obstacle in obstacles],
        "ageMs": age_ms,
    }


def true_obstacles(side: Side, radius: float, sides: Mapping[str, Side], world: World) -> list[ObstacleSeen]:
    """The opponents of a side that are on the field, with this radius in m, and all obstacles, where they are."""
    opponents = [
        ObstacleSeen(robot.x, robot.y, robot.vx, robot.vy, radius)
        for name, robot in world.robots.items()
        if robot.off_field is None and sides.get(name) is side.opponent
    ]
    for body in world.obstacles.values():
        vx, vy = (body.pushed.vx, body.pushed.vy) if body.pushed is not None else (0.0, 0.0)
        opponents.append(ObstacleSeen(body.x, body.y, vx, vy, body.radius))
    return opponents


def _robot(robot: RobotSeen, attack: int) -> dict[str, Any]:
    pose = [*_place(robot.x, robot.y, attack), _short(heading_across(robot.heading, attack))]
    return {
        "id": robot.number,
        "pose": pose,
        "targetPose": pose,
        "velocity": [*_place(robot.vx, robot.vy, attack), _short(robot.omega)],
        "intention": robot.intention,
        "batteryLevel": FULL,
        "ballEngaged": int(robot.holding),
    }


def _ball(ball: BallSeen, attack: int) -> dict[str, Any]:
    return {
        "position": [*_place(ball.x, ball.y, attack), _short(ball.z)],
        "velocity": [*_place(ball.vx, ball.vy, attack), _short(ball.vz)],
        "confidence": _short(ball.confidence),
    }


def _obstacle(obstacle: ObstacleSeen, attack: int) -> dict[str, Any]:
    return {
        "position": _place(obstacle.x, obstacle.y, attack),
        "velocity": _place(obstacle.vx, obstacle.vy, attack),
        "radius": _short(obstacle.radius),
        "confidence": _short(obstacle.confidence),
    }


def _place(x: float, y: float, attack: int) -> list[float]:
    return [_short(value) for value in vector_to_log(x, y, attack)]


def _short(value: Any) -> float:
    return round(float(value), _DIGITS) + 0.0  # no -0.0
