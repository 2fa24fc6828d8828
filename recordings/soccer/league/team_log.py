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

from recordings.soccer.league.record_values import (
    ROBOT_KEYS,
    BallRow,
    RobotReport,
    RobotRow,
    best_ball,
    robot_report,
    robot_row,
    short_text,
    unknown_keys,
)
from schemas.messages.soccer.league.findings import Findings
from schemas.messages.soccer.league.lenient_json import REQUIRED, fields_of, items_of, number

GAP_S = 1.0
"""s without a record after which a team has a gap. Chosen here: ten times the longest period the league allows."""
BURST_S = 0.01
"""s between two records below which they are a burst. Chosen here: no team's program runs at 100 Hz."""
_LATEST_MS = 4e12
"""ms since 1970; a later time, after 2096, is in another unit. Chosen here."""
_MAX_OFFSET_MS = 6 * 3600 * 1000
"""ms from the median record; a record farther away has a wrong clock. Chosen here: no match lasts longer."""
_RECORD = re.compile(r'\{\s*"(?:team|time|game|world)\w*"\s*:', re.IGNORECASE)
"""Beginning of a record, to find the next one after damaged data."""
_BETWEEN = re.compile(r"[\s,\[\]\x00]*")
_DECODER = json.JSONDecoder(strict=False)

_RECORD_KEYS = frozenset({"teamName", "timestamp", "gametimeMs", "worldstate"})
_WORLD_KEYS = frozenset(REQUIRED)
"""Keys whose values are imported, or counted by themselves."""


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
    reports: list[RobotReport] = field(default_factory=list)
    """By time."""


@dataclass(slots=True)
class _Record:
    epoch_ms: float
    number: int
    team: str
    robots: dict[int, RobotRow]
    ball: BallRow | None
    reports: list[RobotReport]
    left_out: list[tuple[str, int]]
    """Data that has no place in a recording, with its number."""


def read_team(text: str, letter: str, findings: Findings, left_out: Findings) -> TeamLog:
    """Read the file of one team; `letter` is A or B. Data without a place in a recording is counted in `left_out`."""
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
        log.reports += record.reports
        left_out.place = f"{letter}, record {record.number}"
        for what, count in record.left_out:
            left_out.note(what, count=count)
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
    if epoch_ms is None or not 0 < epoch_ms < _LATEST_MS:
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
    reports: list[RobotReport] = []
    left_out = unknown_keys(record, _RECORD_KEYS, "record") + unknown_keys(world, _WORLD_KEYS, "worldstate")
    intention = short_text(world.get("intention"), "intention of a team", findings)
    for one in items_of(world.get("robots")):
        fields = fields_of(one, findings)
        read = robot_row(fields, epoch_ms, findings)
        if read is None:
            continue
        name, row = read
        if name in robots:
            findings.note("robot twice in one record, the second left out", lost=True)
            continue
        robots[name] = row
        reports.append(robot_report(fields, name, row, intention, findings))
        left_out += unknown_keys(fields, ROBOT_KEYS, "robot")
    ball, further = best_ball(world, epoch_ms, findings)
    obstacles = len(items_of(world.get("obstacles")))
    left_out += [("obstacles that a team sees", obstacles), ("further balls that a team sees", further)]
    if number(world.get("ageMs"), "ageMs", Findings()):
        left_out.append(("ages of records that are not 0", 1))
    team = record.get("teamName") or world.get("teamName")
    return _Record(
        epoch_ms,
        index,
        team if isinstance(team, str) else "",
        robots,
        ball,
        reports,
        [(what, count) for what, count in left_out if count],
    )


def _in_order(found: list[_Record], letter: str, findings: Findings) -> list[_Record]:
    """The records by time, one for each time, without records of a wrong clock."""
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
        gap_s = (record.epoch_ms - merged[-1].epoch_ms) / 1e3 if merged else BURST_S
        if gap_s == 0:
            findings.note("several records of one time: the last is used")
            merged.pop()
        elif gap_s < BURST_S:
            findings.note(f"records in a burst, less than {BURST_S * 1e3:g} ms apart")
        elif gap_s > GAP_S:
            findings.note(f"gap of more than {GAP_S:g} s: the team's bodies are unknown meanwhile")
        merged.append(record)
    return merged
