"""A legal pose for a robot that the referee moves out of a wrong position before a restart."""

import dataclasses
import math
from collections.abc import Iterator

from schemas.frames import Pose
from sim_host.referee.areas import in_a_penalty_area
from sim_host.referee.game.referee_state import RefereeState
from sim_host.referee.game.restart import Restart, Spot
from sim_host.referee.match_constants import MatchConstants
from sim_host.referee.placement.clear_ground import clearance
from sim_host.referee.placement.positions import LineUp, PositionFault, checks_of, line_up_of, min_distance
from sim_host.snapshot import RobotStates, Snapshot

_ROOM = 0.2
"""m; distance that a moved robot gets beyond the required one, and from other robots."""
_BEARINGS = 24
"""Number of directions from the ball that are tried for a moved robot."""
_RINGS = 8
"""Number of distances that are tried, 1 m apart."""


def legal_pose(
    match: MatchConstants, state: RefereeState, restart: Restart, snapshot: Snapshot, fault: PositionFault
) -> Pose:
    """A legal pose for a robot in a wrong position: on the field, near its bearing from the ball, clear of others.

    The present pose if there is no such place.
    """
    line_up = line_up_of(match, state, restart, snapshot)
    index = match.roster.names.index(fault.robot)
    robot = snapshot.robots[index]
    for x, y in _around(line_up, index):
        moved = RobotStates((*snapshot.robots[:index], robot._replace(x=x, y=y), *snapshot.robots[index + 1 :]))
        tried = line_up._replace(snapshot=dataclasses.replace(snapshot, robots=moved))
        if all(check(tried, index) is None for check in checks_of(state, restart)) and _has_room(tried, index):
            return Pose(x, y, math.atan2(restart.spot[1] - y, restart.spot[0] - x))
    return Pose(robot.x, robot.y, robot.heading)


def _around(line_up: LineUp, index: int) -> Iterator[Spot]:
    """Places on the field around the ball: nearest ring first, from the robot's bearing alternately to both sides."""
    pitch, robot, (x, y) = line_up.match.pitch, line_up.snapshot.robots[index], line_up.restart.spot
    if line_up.is_keeper(index):
        yield line_up.own_end(index) * (pitch.goal_line - line_up.match.reaches[index] - _ROOM), 0.0
    bearing = math.atan2(robot.y - y, robot.x - x)
    nearest = min_distance(line_up, index) + line_up.match.reaches[index] + _ROOM
    for ring in range(_RINGS):
        for step in range(_BEARINGS):
            turn = (step + 1) // 2 * (1 if step % 2 else -1) * math.tau / _BEARINGS
            away = nearest + ring
            place = x + away * math.cos(bearing + turn), y + away * math.sin(bearing + turn)
            if abs(place[0]) <= pitch.goal_line and abs(place[1]) <= pitch.touch_line and not _is_timed(line_up, place):
                yield place


def _is_timed(line_up: LineUp, place: Spot) -> bool:
    """Whether the time of a robot at a place is limited, as in a penalty area."""
    match = line_up.match
    return match.book.areas.penalty_area_stay > 0.0 and in_a_penalty_area(match.pitch, *place)


def _has_room(line_up: LineUp, index: int) -> bool:
    robots, reaches = line_up.snapshot.robots, line_up.match.reaches
    here = robots[index].x, robots[index].y
    if clearance(line_up.snapshot, here) <= reaches[index] + _ROOM:
        return False
    return all(
        math.dist(here, (robots[other].x, robots[other].y)) > reaches[index] + reaches[other] + _ROOM
        for other in line_up.on_field
        if other != index
    )
