"""The penalty shoot-out of both shipped teams: the kicker, where the others wait, and one kick at a corner.

The kicker waits in the centre circle until START, drives up to the ball, and kicks from the mark. All other robots but
the goalkeepers stand beyond the halfway line, outside the centre circle.
"""

import math
from collections.abc import Sequence

from robot_agent.sdk.bodies import DriveLimits
from robot_agent.sdk.skills.avoid import circles, go_around
from robot_agent.sdk.world_model import WorldBelief
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.teams.set_piece import step_in
from schemas.config.sections import Pitch
from schemas.messages.command import Drive, Kick
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameView
from schemas.soccer.game import TeamPhase

WAITS = 0.7
"""m before the halfway line where the kicker waits, in the centre circle."""
CLEAR = 0.5
"""m of air between the halfway line and the other robots."""
SPACING = 0.9
"""m between two of them."""
CORNER = 0.35
"""Distance from the goal's middle that the kick aims at, as a share of the goal's width."""
OFF_THE_MIDDLE = 0.2
"""m of a goalkeeper beside the middle of its goal after which the other corner counts as open; above camera noise."""
SPEED = 0.6
"""Share of the fastest kick."""
ERROR = 0.15
"""m beside the target, at most."""


def kicker_of(robots: Sequence[str], keeper: str | None, game: GameView) -> str:
    """The first robot of the team on the field; the goalkeeper comes last."""
    there = [name for name in robots if name not in game.robots or game.robots[name].off_field is None]
    field = [name for name in there if name != keeper]
    return (field or there or list(robots))[0]


def wait(belief: WorldBelief, number: int, count: int, setup: Setup, limits: DriveLimits) -> Drive:
    """Wait beyond the halfway line, in as many rows as necessary.

    The first robots of the list, which arrive first, have the farthest row: they do not wall off the line.

    Args:
        number: the robot's place in its team's list, from 1.
        count: the number of robots in the list.
    """
    pitch, reach = setup.pitch, setup.robot.reach
    beyond = -1.0 if belief.game.phase is TeamPhase.OUR_PENALTY else 1.0
    in_a_row = max(1, int((pitch.touch_line - reach - pitch.centre_circle_radius) / SPACING))
    row, place = divmod(number - 1, in_a_row)
    x = beyond * (reach + CLEAR + ((count - 1) // in_a_row - row) * SPACING)
    # left of its own attack: each team has a side of its own
    y = pitch.centre_circle_radius + (place + 1) * SPACING
    blocked = circles(belief.others, 2.0 * setup.robot.reach + 0.1)
    return go_around(belief.me, x, y, math.atan2(-y, -x), blocked, limits)


def wait_for_start(belief: WorldBelief, setup: Setup, limits: DriveLimits) -> Drive:
    """Wait in the centre circle, facing the goal."""
    blocked = circles(belief.others, 2.0 * setup.robot.reach + 0.1)
    return go_around(belief.me, -WAITS, 0.0, 0.0, blocked, limits)


def take_penalty(belief: WorldBelief, setup: Setup, limits: DriveLimits) -> tuple[Drive, Kick | None]:
    """After START: drive to the ball, and kick it along the ground at a corner."""
    pitch, ball = setup.pitch, belief.ball
    if ball is None:
        return Drive(), None
    target = (pitch.goal_line, _side(belief, pitch) * CORNER * pitch.goal_width)
    if belief.holding:
        return kick_at(belief.me, target, SPEED * setup.kicker.max_ground_speed, ERROR, limits)
    return step_in(belief.me, (ball.now.x, ball.now.y), target, setup, limits), None


def _side(belief: WorldBelief, pitch: Pitch) -> float:
    """The sign of the corner's y: where the kick axis points, unless the goalkeeper clearly stands there."""
    me = belief.me
    _, keeper = min(belief.opponents, key=lambda place: math.dist(place, (pitch.goal_line, 0.0)), default=(0.0, 0.0))
    points = math.copysign(1.0, me.y + (pitch.goal_line - me.x) * math.tan(me.heading))
    return -points if keeper * points > OFF_THE_MIDDLE else points
