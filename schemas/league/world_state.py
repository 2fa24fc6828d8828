"""A team's view of the world in the schema MSLWMD of the league's RefBox, made from the field frame.

`world_state` gives the plain object of the league's JSON: metres, m/s, rad, in that team's own axes.
"""

from collections.abc import Iterable
from typing import Any, NamedTuple

from schemas.league.axes import heading_across, vector_to_log

_DIGITS = 3
"""After the point, as the format's own description has it: mm and mrad."""
FULL = 100.0
"""Battery level in percent of a robot that nobody asks: a simulated one does not run out."""


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
    """A ball: centre in m, velocity in m/s, in the field frame; how sure the team is of it, 0 to 1."""

    x: float
    y: float
    z: float
    vx: float
    vy: float
    vz: float
    confidence: float = 1.0


class ObstacleSeen(NamedTuple):
    """Something in the way: centre in m, velocity in m/s, in the field frame; radius in m; confidence 0 to 1."""

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
    """The league's object for the team of that name, which attacks `attack` (+1 or −1) along x.

    Where a robot is going to, which the schema asks for, nobody says: its own pose stands in.
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
