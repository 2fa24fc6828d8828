"""Set pieces of both shipped teams: how far to stay away, where to stand, how to take one."""

import math
from collections.abc import Sequence

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.skills.avoid import Circle, bend_speed, circles_near, go_around
from robot_agent.sdk.skills.go_to import drive
from robot_agent.sdk.skills.keep_out import Area
from robot_agent.sdk.skills.turn_to import turn_rate
from robot_agent.soccer.skills.keep_off import inside, keep_off, way_around
from robot_agent.soccer.skills.line_up import line_up
from schemas.config.sections import Pitch
from schemas.config.soccer.rule_book import Restarts
from schemas.messages.command import Drive
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameView
from schemas.soccer.game import TeamPhase

MARGIN = 0.2
"""m beyond the required distance, for the noise of positions."""
ASIDE = 0.4
"""m of air, in play, between the ball and the hull of a robot that does not play it."""
LINE_UP = 0.25
"""m of air between the taker's hull and the ball before START."""
KICK_OFFS = frozenset({TeamPhase.OUR_KICK_OFF, TeamPhase.THEIR_KICK_OFF})
PENALTIES = frozenset({TeamPhase.OUR_PENALTY, TeamPhase.THEIR_PENALTY})


def required_distance(phase: TeamPhase, restarts: Restarts) -> float:
    """The required distance of a robot that does not take the restart from the ball, hull to ball, in m; 0 in play."""
    if phase is TeamPhase.PLAY:
        return 0.0
    if phase is TeamPhase.DROP_BALL:
        return restarts.drop_ball_distance
    if phase in PENALTIES or phase.theirs:
        return restarts.opponent_distance
    return restarts.teammate_distance if phase.ours else 0.0


def before_own_goal(spot: tuple[float, float], pitch: Pitch, distance: float = 1.0) -> tuple[float, float]:
    """A place `distance` m from the ball toward the own goal; the rules of the phase move it farther away."""
    dx, dy = -pitch.goal_line - spot[0], -spot[1]
    away = max(math.hypot(dx, dy), 1e-6)
    return spot[0] + distance * dx / away, spot[1] + distance * dy / away


def legal_place(
    x: float,
    y: float,
    game: GameView,
    spot: tuple[float, float],
    setup: Setup,
    taken: Sequence[tuple[float, float]] = (),
) -> tuple[float, float]:
    """The nearest place to the wanted one where a robot that does not take the restart may stand.

    The distance from the ball moves no place into a penalty area, where few robots of a side may be, and none to a
    place that is taken.
    """
    pitch, radius, phase = setup.pitch, setup.robot.reach, game.phase
    if phase in KICK_OFFS:
        x = min(x, -radius - MARGIN)
    if phase in PENALTIES:
        x = math.copysign(min(abs(x), pitch.goal_line - pitch.penalty_mark - setup.restarts.opponent_distance), x)
    distance = required_distance(phase, setup.restarts)
    if distance == 0.0:
        return inside(x, y, pitch, radius)
    areas = Area.penalty(pitch)
    outside = None if areas.has(math.copysign(1.0, x), x, y) else areas
    return keep_off(x, y, spot, distance + radius + MARGIN, pitch, radius, outside, taken)


def stand(
    me: Body,
    place: tuple[float, float],
    game: GameView,
    spot: tuple[float, float],
    others: Sequence[tuple[float, float]],
    setup: Setup,
    limits: DriveLimits,
    taken: Sequence[tuple[float, float]] = (),
) -> Drive:
    """Go to a place and face the spot, around all other robots and around the circle that the rules require.

    In play the spot is the ball: a robot that does not play it keeps away from it and from the path of the one that
    does. Before a kick-off, START waits for robots in the other half: they return past the ball, through the circle.
    """
    radius = setup.robot.reach
    x, y = legal_place(*place, game, spot, setup, taken)
    facing = math.atan2(spot[1] - me.y, spot[0] - me.x)
    blocked = circles_near(me, others, 2.0 * radius + 0.1)
    required = required_distance(game.phase, setup.restarts)
    goes_home = game.phase in KICK_OFFS and not game.running and me.x > 0.0
    if required == 0.0 or goes_home:
        blocked.append(Circle(*spot, radius + setup.ball.radius + ASIDE))
        return go_around(me, x, y, facing, blocked, limits)
    forbidden = required + radius + 0.5 * MARGIN
    away = max(0.01, math.hypot(me.x - spot[0], me.y - spot[1]))
    if away > forbidden:
        x, y = way_around(me, (x, y), spot, forbidden, setup.pitch, radius, Area.penalty(setup.pitch))
        blocked.append(Circle(*spot, forbidden))
        limits = limits.capped(bend_speed(away, forbidden, limits))
    else:
        x, y = keep_off(me.x, me.y, spot, forbidden + MARGIN, setup.pitch, radius, Area.penalty(setup.pitch))
    return go_around(me, x, y, facing, blocked, limits)


def wait_behind(
    me: Body,
    spot: tuple[float, float],
    target: tuple[float, float],
    others: Sequence[tuple[float, float]],
    setup: Setup,
    limits: DriveLimits,
) -> Drive:
    """Before START: wait behind the ball, in line with the target, without touching the ball."""
    distance = setup.robot.radius + setup.ball.radius + LINE_UP
    return line_up(me, spot, target, distance, circles_near(me, others, 2.0 * setup.robot.reach + 0.1), limits)


def step_in(
    me: Body, ball: tuple[float, float], target: tuple[float, float], setup: Setup, limits: DriveLimits
) -> Drive:
    """After START: drive straight at the ball along the line to the target, until the dribbler holds it.

    `ball` is where the robot sees it: from the referee's spot it may lie some centimetres away, and so near that is an
    angle at which the dribbler pushes it and does not hold it.
    """
    distance = math.hypot(ball[0] - me.x, ball[1] - me.y)
    heading = math.atan2(target[1] - ball[1], target[0] - ball[0])
    beside = abs((me.y - ball[1]) * math.cos(heading) - (me.x - ball[0]) * math.sin(heading))
    if distance > 2.0 * setup.dribble.distance or beside > 0.15:
        return wait_behind(me, ball, target, (), setup, limits)
    facing = math.atan2(ball[1] - me.y, ball[0] - me.x)
    speed = 0.3 + min(1.0, 2.0 * max(0.0, distance - setup.dribble.gap))
    c, s = math.cos(facing), math.sin(facing)
    return drive(me, speed * c, speed * s, turn_rate(me, facing, limits), limits)
