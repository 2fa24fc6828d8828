"""Reads one team's file of a log, record by record, as far as each record can be read.

Real logs deviate from their schema in many ways. Each kind of deviation is counted, and data that is left out is
reported.
"""

import json
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from statistics import median
from typing import Any

from schemas.league.findings import Findings
from schemas.league.lenient_json import REQUIRED, fields_of, items_of, number, vector

GAP_S = 1.0
"""s without a record after which a team has a gap. Chosen here: ten times the longest period the league allows."""
_BURST_S = 0.01
"""s between two records below which they are a burst. Chosen here: no team's program runs at 100 Hz."""
_MAX_COORDINATE_M = 40.0
"""m; a larger coordinate is an error. Chosen here: the league's longest pitch has 22 m, so goal lines at 11 m."""
_MAX_OFFSET_MS = 6 * 3600 * 1000
"""ms from the median record; a record farther away has a wrong clock. Chosen here: no match lasts longer."""
_RECORD = re.compile(r'\{\s*"(?:team|time|game|world)\w*"\s*:', re.IGNORECASE)
"""Beginning of a record, to find the next one after damaged data."""
_BETWEEN = re.compile(r"[\s,\[\]\x00]*")
_DECODER = json.JSONDecoder(strict=False)

RobotRow = tuple[float, float, float, float, float, float, float, float]
"""Time in ms; x, y, heading, vx, vy, omega in the league's axes, NaN if unknown; 1 with the ball, else 0."""
BallRow = tuple[float, float, float, float, float, float, float, float]
"""Time in ms; x, y, z, vx, vy, vz in the league's axes, NaN if unknown; the team's confidence."""


@dataclass(slots=True)
class TeamLog:
    """The records of one team, by time."""

    team: str = ""
    records: int = 0
    """Records in the file."""
    read: int = 0
    """Records with a world state that could be read."""
    times_ms: list[float] = field(default_factory=list)
    """Times of the records that were read, in ms since 1970."""
    robots: dict[int, list[RobotRow]] = field(default_factory=dict)
    balls: list[BallRow] = field(default_factory=list)


@dataclass(slots=True)
class _Record:
    epoch_ms: float
    number: int
    team: str
    robots: dict[int, RobotRow]
    ball: BallRow | None


def read_team(text: str, letter: str, findings: Findings) -> TeamLog:
    """Read the file of one team; `letter` is A or B."""
    log = TeamLog()
    found: list[_Record] = []
    for index, raw in enumerate(_raw_records(text, letter, findings), 1):
        log.records = index
        findings.place = f"{letter}, record {index}"
        record = _record(raw, index, findings)
        if record is not None:
            found.append(record)
    kept = _in_order(found, letter, findings)
    log.read = len(kept)
    log.team = next((record.team for record in kept if record.team), "")
    log.times_ms = [record.epoch_ms for record in kept]
    for record in kept:
        for robot, row in record.robots.items():
            log.robots.setdefault(robot, []).append(row)
        if record.ball is not None:
            log.balls.append(record.ball)
    return log


def _raw_records(text: str, letter: str, findings: Findings) -> Iterator[Any]:
    """Yield every record of the file as plain JSON; after damaged data, continue with the next record."""
    position, count, damaged = 0, 0, False
    while True:
        between = _BETWEEN.match(text, position)
        position = between.end() if between is not None else position
        if position >= len(text):
            return
        try:
            raw, position = _DECODER.raw_decode(text, position)
        except (ValueError, RecursionError) as error:
            findings.place = f"{letter}, behind record {count}"
            findings.note("damaged, not JSON up to the next record", lost=True)
            following = _RECORD.search(text, max(position, getattr(error, "pos", position)) + 1)
            if following is None:
                return
            position, damaged = following.start(), True
            continue
        if damaged and not (isinstance(raw, dict) and fields_of(raw, Findings()).get("timestamp")):
            continue  # the rest of the damaged record
        damaged = False
        count += 1
        yield raw


def _record(raw: Any, index: int, findings: Findings) -> _Record | None:
    record = fields_of(raw, findings)
    epoch_ms = number(record.get("timestamp"), "timestamp", findings)
    if epoch_ms is None or epoch_ms <= 0:
        findings.note("record without a time", lost=True)
        return None
    content = record.get("worldstate")
    if isinstance(content, str):
        findings.note("worldstate is a string of JSON")
        try:
            content = _DECODER.decode(content)
        except (ValueError, RecursionError):
            content = None
    world = fields_of(content, findings)
    if not world:
        findings.note("record without a worldstate", lost=True)
        return None
    for key in REQUIRED:
        if key not in world:
            findings.note(f"worldstate without {key}")
    robots: dict[int, RobotRow] = {}
    for one in items_of(world.get("robots")):
        read = _robot(fields_of(one, findings), epoch_ms, findings)
        if read is None:
            continue
        name, row = read
        if name in robots:
            findings.note("robot twice in one record, the second left out", lost=True)
        else:
            robots[name] = row
    team = record.get("teamName") or world.get("teamName")
    return _Record(
        epoch_ms, index, team if isinstance(team, str) else "", robots, _best_ball(world, epoch_ms, findings)
    )


def _robot(robot: dict[str, Any], epoch_ms: float, findings: Findings) -> tuple[int, RobotRow] | None:
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


def _best_ball(world: dict[str, Any], epoch_ms: float, findings: Findings) -> BallRow | None:
    """The ball with the team's highest confidence."""
    best: BallRow | None = None
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
            findings.note("ball without a confidence: it counts as 1")
            confidence = 1.0
        if not 0 <= confidence <= 1:
            findings.note("confidence outside 0 to 1: limited to that range")
            confidence = min(1.0, max(0.0, confidence))
        if best is None or confidence > best[-1]:
            vx, vy, vz = (_or_nan(value) for value in velocity)
            best = (epoch_ms, x, y, _or_nan(z), vx, vy, vz, confidence)
    return best


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value


def _in_order(found: list[_Record], letter: str, findings: Findings) -> list[_Record]:
    """The records by time, one for each time, without those of a wrong clock."""
    if not found:
        return []
    middle = median(record.epoch_ms for record in found)
    kept: list[_Record] = []
    newest = -math.inf
    for record in found:
        findings.place = f"{letter}, record {record.number}"
        if abs(record.epoch_ms - middle) > _MAX_OFFSET_MS:
            findings.note("record hours away from the others", lost=True)
            continue
        if record.epoch_ms < newest:
            findings.note("record out of order: sorted by time")
        newest = max(newest, record.epoch_ms)
        kept.append(record)
    kept.sort(key=lambda record: record.epoch_ms)
    merged: list[_Record] = []
    for record in kept:
        findings.place = f"{letter}, record {record.number}"
        gap_s = (record.epoch_ms - merged[-1].epoch_ms) / 1e3 if merged else _BURST_S
        if gap_s == 0:
            findings.note("several records of one time: the last is used")
            merged.pop()
        elif gap_s < _BURST_S:
            findings.note(f"records in a burst, less than {_BURST_S * 1e3:g} ms apart")
        elif gap_s > GAP_S:
            findings.note(f"gap of more than {GAP_S:g} s: the team's bodies are unknown meanwhile")
        merged.append(record)
    return merged
