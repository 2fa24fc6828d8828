"""Release the ball for a moment: a soft kick ahead, which the robot follows, so that it may dribble on."""

import math
from collections.abc import Sequence

from robot_agent.sdk.bodies import Moving
from robot_agent.soccer.skills.keep_off import inside
from robot_agent.soccer.skills.shoot import lane_width
from schemas.config.rolling import GRAVITY
from schemas.frames import Point
from schemas.messages.command import Kick, KickMode
from schemas.messages.setup import Setup

AIR = 0.2
"""m by which the ball gets away from a robot that accelerates after it. The rule book asks for 0.1 m of air, and a held
ball is up to 4 mm deep in the hull."""
AHEAD = 1.8
"""m of ground that must be free of opponents for it."""
CATCHES = 0.8
"""s until a robot has the ball again and has turned: it must not be over a line by then."""
LINE_ROOM = 0.3
"""m from the lines to where the robot has it again."""
FREE = 0.8
"""m; an opponent nearer to the ball would be at it first."""
ROOM = 0.45
"""m between the path of the ball and the nearest opponent's centre."""


def let_go(me: Moving, opponents: Sequence[Point], setup: Setup) -> Kick | None:
    """The kick along the kick axis; None when there is no free ground on the pitch ahead, or an opponent is near."""
    c, s = math.cos(me.heading), math.sin(me.heading)
    gap = setup.dribble.gap
    ball = (me.x + gap * c, me.y + gap * s)
    speed = max(0.0, me.vx * c + me.vy * s)
    end = (ball[0] + AHEAD * c, ball[1] + AHEAD * s)
    rolls = AHEAD + CATCHES * speed
    last = (ball[0] + rolls * c, ball[1] + rolls * s)
    if inside(*last, setup.pitch, LINE_ROOM) != last or lane_width(ball, end, opponents) < ROOM:
        return None
    if any(math.dist(ball, opponent) < FREE for opponent in opponents):
        return None
    return Kick(mode=KickMode.GROUND, speed=faster(setup) + speed)


def faster(setup: Setup) -> float:
    """m/s that the ball gets more than the robot has: a ball that is kicked without spin slides at first."""
    slides = setup.kicker.kick_spin < 1.0
    slows = GRAVITY * setup.ball.friction if slides else setup.ball.rolling_deceleration
    return math.sqrt(2.0 * (slows + setup.drive.acceleration) * AIR)
