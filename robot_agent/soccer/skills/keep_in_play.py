"""Keep the ball on the pitch: the speed with which it would leave is braked in time."""

import math

from robot_agent.sdk.bodies import DriveLimits, Moving
from robot_agent.sdk.skills.braking import braking_speed
from robot_agent.sdk.skills.go_to import LAG, drive
from robot_agent.soccer.skills.keep_hold import hold_deceleration
from schemas.frames import rotate
from schemas.messages.command import Drive
from schemas.messages.setup import Setup


def keep_in_play(me: Moving, ball: tuple[float, float], wanted: Drive, setup: Setup, limits: DriveLimits) -> Drive:
    """The same demand, braked so that a robot with the ball can stop before the ball is over a line.

    The opponents' goal is no line: a ball may be carried into it.
    """
    pitch, brakes = setup.pitch, min(hold_deceleration(setup), limits.deceleration)
    vx, vy = rotate(wanted.vx, wanted.vy, me.heading)
    most_y = braking_speed(pitch.touch_line - math.copysign(ball[1], ball[1] * vy), brakes, LAG)
    most_x = braking_speed(pitch.goal_line - math.copysign(ball[0], ball[0] * vx), brakes, LAG)
    if vx > 0.0 and abs(ball[1]) < 0.5 * pitch.goal_width:
        most_x = math.inf
    if abs(vx) <= most_x and abs(vy) <= most_y:
        return wanted
    return drive(me, max(-most_x, min(most_x, vx)), max(-most_y, min(most_y, vy)), wanted.omega, limits)
