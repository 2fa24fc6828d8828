"""Legal poses for robots that the referee moves out of wrong positions before a restart."""

import math
from collections.abc import Iterator, Sequence

from schemas.frames import Pose
from sim_host.snapshot import Snapshot
from sim_host.soccer.referee.areas import in_a_penalty_area
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.restart import Restart, Spot
from sim_host.soccer.referee.game.set_piece import PositionFault
from sim_host.soccer.referee.match_constants import MatchConstants
from sim_host.soccer.referee.placement.clear_ground import clearance
from sim_host.soccer.referee.placement.positions import LineUp, checks_of, line_up_of, min_distance

_ROOM = 0.2
"""m; distance that a moved robot gets beyond the required one, and from other robots."""
_BEARINGS = 24
"""Number of directions from the ball that are tried for a moved robot."""


def legal_poses(
    match: MatchConstants, state: RefereeState, restart: Restart, snapshot: Snapshot, faults: Sequence[PositionFault]
) -> list[Pose]:
    """A legal pose for each robot in a wrong position: on the field, near its bearing from the ball, clear of others.

    The present pose of a robot if there is no such place.
    """
    line_up, poses = line_up_of(match, state, restart, snapshot), []
    for place, fault in enumerate(faults):
        line_up = line_up._replace(waiting=[later.robot for later in faults[place + 1 :]])
        pose = _legal_pose(line_up, fault.robot)
        line_up = line_up._replace(snapshot=line_up.snapshot.with_robot_at(fault.robot, pose))
        poses.append(pose)
    return poses


def _legal_pose(line_up: LineUp, name: str) -> Pose:
    index, snapshot, spot = line_up.match.roster.names.index(name), line_up.snapshot, line_up.restart.spot
    robot, checks = snapshot.robots[index], checks_of(line_up.state, line_up.restart)
    for x, y in _around(line_up, index):
        pose = Pose(x, y, math.atan2(spot[1] - y, spot[0] - x))
        tried = line_up._replace(snapshot=snapshot.with_robot_at(name, pose))
        if all(check(tried, index) is None for check in checks) and _has_room(tried, index):
            return pose
    return Pose(robot.x, robot.y, robot.heading)


def _around(line_up: LineUp, index: int) -> Iterator[Spot]:
    """Places on the field around the ball: nearest ring first, from the robot's bearing alternately to both sides."""
    pitch, robot, (x, y) = line_up.match.pitch, line_up.snapshot.robots[index], line_up.restart.spot
    if line_up.is_keeper(index):
        yield line_up.own_end(index) * (pitch.goal_line - line_up.match.reaches[index] - _ROOM), 0.0
    bearing = math.atan2(robot.y - y, robot.x - x)
    nearest = min_distance(line_up, index) + line_up.match.reaches[index] + _ROOM
    for ring in range(math.ceil(pitch.length)):
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
    if clearance(line_up.snapshot.obstacles, here) <= reaches[index] + _ROOM:
        return False
    return all(
        math.dist(here, (robots[other].x, robots[other].y)) > reaches[index] + reaches[other] + _ROOM
        for other in line_up.on_field
        if other != index and line_up.match.roster.names[other] not in line_up.waiting
    )
