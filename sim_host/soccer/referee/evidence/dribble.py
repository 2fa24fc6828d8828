"""A dribble: the robot that has the ball, the time and place of the catch, and the motion since.

It begins when a robot holds the ball. It goes on while the hold is briefly interrupted, until the ball is visibly
released: it is as far from the hull as the rule book requires, or another robot holds or touches it.
"""

import math
from typing import NamedTuple

from sim_host.snapshot import RobotState, Snapshot
from sim_host.soccer.referee.evidence.contest import Contest
from sim_host.soccer.referee.match_constants import MatchConstants

STANDS = 0.05
"""m/s along the kick axis; slower motion is neither forward nor backward, but noise of a robot that holds its place."""
PAUSE = 0.5
"""s; a backward movement ends after this time without backward motion."""
MOVES = 0.1
"""m/s; a slower ball is not required to turn."""
TURNS = 0.5
"""Share of the natural spin below which a ball does not roll, but is kept from turning."""


class Dribble(NamedTuple):
    """One dribble, up to the present tick."""

    robot: str
    since: float
    """s; simulated time of the catch."""
    caught: tuple[float, float]
    """m; place of the ball at the catch."""
    backward: float = 0.0
    """m driven backward in the present backward movement."""
    halted: float = 0.0
    """s since it last moved backward."""
    spent: bool = False
    """One backward movement was so long that the rule book does not allow another."""
    slid: float = 0.0
    """s for which the ball has moved with the robot without rolling."""
    slid_way: float = 0.0
    """m that it has moved without rolling."""
    rolled: float = 0.0
    """s since it last moved without rolling."""


def dribble_after(
    match: MatchConstants, before: Dribble | None, contest: Contest | None, snapshot: Snapshot, dt: float
) -> Dribble | None:
    """The dribble after one more tick of `dt` in s, or None."""
    holder = snapshot.possession
    if holder is not None and (before is None or before.robot != holder):
        return Dribble(holder, snapshot.time, (snapshot.ball.x, snapshot.ball.y))
    if before is None or is_released(match, before, snapshot):
        return None
    robot = snapshot.robots[match.roster.names.index(before.robot)]
    backed = _backing(match, before, contest, robot, dt)
    return _rolling(match, backed, snapshot, dt) if contest is None else backed


def is_released(match: MatchConstants, dribble: Dribble, snapshot: Snapshot) -> bool:
    """Whether the robot has visibly released the ball."""
    if snapshot.possession == dribble.robot:
        return False
    if any(name != dribble.robot for name in snapshot.touches):
        return True
    index = match.roster.names.index(dribble.robot)
    robot, ball = snapshot.robots[index], snapshot.ball
    air = math.hypot(ball.x - robot.x, ball.y - robot.y) - match.roster.models[index].body.radius - match.ball.radius
    return air >= match.book.handling.release_gap


def _backing(match: MatchConstants, before: Dribble, contest: Contest | None, robot: RobotState, dt: float) -> Dribble:
    """Update the backward movement; a long enough struggle with an opponent allows a new one."""
    handling = match.book.handling
    if contest is not None and contest.lasted > handling.struggle_duration:
        return before._replace(backward=0.0, halted=0.0, spent=False) if before.backward or before.spent else before
    along = robot.vx * math.cos(robot.heading) + robot.vy * math.sin(robot.heading)
    if along < -STANDS:
        return before._replace(backward=before.backward - along * dt, halted=0.0)
    if not before.backward:
        return before
    halted = before.halted + dt
    if halted < PAUSE:
        return before._replace(halted=halted)
    spent = before.spent or before.backward > handling.backward_once
    return before._replace(backward=0.0, halted=0.0, spent=spent)


def _rolling(match: MatchConstants, before: Dribble, snapshot: Snapshot, dt: float) -> Dribble:
    """Update time and way for which the held ball moves without rolling."""
    ball = snapshot.ball
    speed = math.hypot(ball.vx, ball.vy)
    wx, wy = snapshot.ball_spin
    turning = match.ball.radius * (wy * ball.vx - wx * ball.vy)  # a ball that rolls has turning = speed²
    if snapshot.possession == before.robot and speed > MOVES and turning < TURNS * speed * speed:
        return before._replace(slid=before.slid + dt, slid_way=before.slid_way + speed * dt, rolled=0.0)
    if not before.slid:
        return before
    rolled = before.rolled + dt
    if rolled < match.book.handling.roll_pause:
        return before._replace(rolled=rolled)
    return before._replace(slid=0.0, slid_way=0.0, rolled=0.0)
