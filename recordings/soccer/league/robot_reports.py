"""What each robot reports in a log, as the beliefs of a recording: its pose, target, battery and intention."""

import math
from collections.abc import Iterator

from recordings.editing.compose import TimedMessage
from recordings.soccer.league import LOG_PERIOD
from recordings.soccer.league.record_values import RobotReport
from recordings.soccer.league.team_log import TeamLog
from schemas.messages.radio import Belief, Motion, Radio
from schemas.messages.soccer.league.axes import vector_to_field
from schemas.side import Side
from schemas.topics import BELIEF

_TEAM_FRAME = 1
"""The direction of attack for which the field frame is the team frame."""


def belief_messages(side: Side, log: TeamLog, start_ms: float) -> Iterator[TimedMessage]:
    """A belief for each robot in each record of a team, by time; `start_ms` is the beginning, in ms since 1970."""
    for report in log.reports:
        time = (report.epoch_ms - start_ms) / 1e3
        robot = f"{side.value}{report.number}"
        key = BELIEF.fill(side=side.value, robot=robot)
        belief = Belief(tick=int(time / LOG_PERIOD + 1e-6), time=time, robot=robot, radio=_radio(report))
        yield TimedMessage(round(time * 1e9), BELIEF, key, belief)


def _radio(report: RobotReport) -> Radio:
    x, y = vector_to_field(report.x, report.y, _TEAM_FRAME)
    vx, vy = vector_to_field(_or_zero(report.vx), _or_zero(report.vy), _TEAM_FRAME)
    heading = _or_zero(report.heading)
    motion = Motion(x=x, y=y, heading=heading, vx=vx, vy=vy, omega=_or_zero(report.omega))
    extra: dict[str, float | int | bool | str] = {}
    if report.target is not None:
        target_x, target_y = vector_to_field(report.target[0], report.target[1], _TEAM_FRAME)
        extra |= {"target_x": target_x, "target_y": target_y}
        if not math.isnan(report.target[2]):
            extra["target_heading"] = report.target[2]
    if report.battery is not None:
        extra["battery"] = report.battery
    if report.team_intention:
        extra["team_intention"] = report.team_intention
    return Radio(self=motion, intention=report.intention or None, extra=extra)


def _or_zero(value: float) -> float:
    return 0.0 if math.isnan(value) else value
