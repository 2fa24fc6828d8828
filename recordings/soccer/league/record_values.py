"""Reads the robots and balls of one record of a log, as far as they can be read."""

import math
from typing import Any, NamedTuple

from schemas.messages.soccer.league.findings import Findings
from schemas.messages.soccer.league.lenient_json import fields_of, items_of, number, vector

_MAX_COORDINATE_M = 40.0
"""m; a larger coordinate is an error. Chosen here: the league's longest pitch has 22 m, so goal lines at 11 m."""
_TEXT = 80
"""Most characters of a text in a radio message."""
ROBOT_KEYS = frozenset({"id", "pose", "position", "targetPose", "velocity", "intention", "batteryLevel", "ballEngaged"})
"""Keys whose values are imported, or counted by themselves."""

RobotRow = tuple[float, float, float, float, float, float, float, float]
"""Time in ms; x, y, heading, vx, vy, omega in the league's axes, NaN if unknown; 1 with the ball, else 0."""
BallRow = tuple[float, float, float, float, float, float, float, float]
"""Time in ms; x, y, z, vx, vy, vz in the league's axes; the team's confidence from 0 to 1. NaN if unknown."""


class RobotReport(NamedTuple):
    """What one robot reports in one record, in the league's axes; unknown numbers are NaN."""

    epoch_ms: float
    number: int
    x: float
    y: float
    heading: float
    vx: float
    vy: float
    omega: float
    target: tuple[float, float, float] | None
    """Pose that it drives to; None if unknown."""
    battery: float | None
    """Percent; None if unknown."""
    intention: str
    team_intention: str
    """The intention of its team in this record."""


def robot_report(fields: dict[str, Any], name: int, row: RobotRow, intention: str, findings: Findings) -> RobotReport:
    """What a robot reports besides its pose."""
    x, y, heading = vector(fields.get("targetPose"), 3, "targetPose", findings)
    target = None if x is None or y is None else (x, y, _or_nan(heading))
    battery = number(fields.get("batteryLevel"), "batteryLevel", findings)
    own = short_text(fields.get("intention"), "intention of a robot", findings)
    return RobotReport(row[0], name, *row[1:7], target, battery, own, intention)


def short_text(value: Any, what: str, findings: Findings) -> str:
    """A text of at most `_TEXT` characters."""
    if not isinstance(value, str):
        return ""
    if len(value) > _TEXT:
        findings.note(f"{what} longer than {_TEXT} characters: shortened")
    return value[:_TEXT]


def unknown_keys(fields: dict[str, Any], known: frozenset[str], what: str) -> list[tuple[str, int]]:
    return [(f'values of the key "{key}" of a {what}', 1) for key in fields if key not in known]


def robot_row(robot: dict[str, Any], epoch_ms: float, findings: Findings) -> tuple[int, RobotRow] | None:
    given = robot.get("id")
    name = number(given, "id of a robot", findings)
    if name is None or name != int(name) or not 0 <= name < 1000:
        findings.note("robot without a number", lost=True)
        return None
    if isinstance(given, float):
        findings.note("id of a robot written as 1.0")
    pose = robot["pose"] if "pose" in robot else robot.get("position")
    x, y, heading = vector(pose, 3, "pose", findings)
    if x is None or y is None:
        findings.note("robot without a position", lost=True)
        return None
    if max(abs(x), abs(y)) > _MAX_COORDINATE_M:
        findings.note(f"robot more than {_MAX_COORDINATE_M:g} m from the centre", lost=True)
        return None
    if heading is None:
        findings.note("robot without a heading: its last one is used")
    velocity = vector(robot.get("velocity"), 3, "velocity of a robot", findings)
    if velocity[0] is None or velocity[1] is None:
        findings.note("robot without a velocity: derived from its positions")
    engaged = robot.get("ballEngaged")
    if isinstance(engaged, bool):
        findings.note("ballEngaged is true or false, not 1 or 0")
    has_ball = number(engaged, "ballEngaged", findings)
    if has_ball is None:
        findings.note("robot without ballEngaged: it counts as 0")
    rest = [_or_nan(value) for value in (heading, *velocity)]
    return int(name), (epoch_ms, x, y, rest[0], rest[1], rest[2], rest[3], float((has_ball or 0.0) > 0.5))


def best_ball(world: dict[str, Any], epoch_ms: float, findings: Findings) -> tuple[BallRow | None, int]:
    """The ball with the team's highest confidence, and the number of further balls."""
    best: BallRow | None = None
    count = 0
    for one in items_of(world.get("balls")):
        ball = fields_of(one, findings)
        x, y, z = vector(ball.get("position"), 3, "position of a ball", findings)
        if x is None or y is None:
            findings.note("ball without a position", lost=True)
            continue
        if max(abs(x), abs(y)) > _MAX_COORDINATE_M:
            findings.note(f"ball more than {_MAX_COORDINATE_M:g} m from the centre", lost=True)
            continue
        velocity = vector(ball.get("velocity"), 3, "velocity of a ball", findings)
        if velocity[0] is None or velocity[1] is None:
            findings.note("ball without a velocity: derived from its positions")
        confidence = number(ball.get("confidence"), "confidence", findings)
        if confidence is None:
            findings.note("ball without a confidence: it is unknown")
        elif not 0 <= confidence <= 1:
            findings.note("confidence outside 0 to 1: it is unknown")
            confidence = None
        count += 1
        if best is None or (confidence is not None and not confidence <= best[-1]):
            vx, vy, vz = (_or_nan(value) for value in velocity)
            best = (epoch_ms, x, y, _or_nan(z), vx, vy, vz, _or_nan(confidence))
    return best, max(0, count - 1)


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value
