"""The robot with the ball: shoot when the goal is open, pass when pressed, else carry the ball to where it is open."""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.skills.avoid import circles
from robot_agent.sdk.skills.go_to import drive
from robot_agent.sdk.world_model import Teammate, places_of
from robot_agent.soccer.skills.dribble_to import dribble_to
from robot_agent.soccer.skills.keep_off import inside
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.soccer.skills.pass_to import EASE, best_receiver, is_open, pass_speed, pass_to
from robot_agent.soccer.skills.shoot import best_place, lane_width
from robot_agent.teams.action import Action
from robot_agent.teams.simple.roles import Role
from schemas.config.sections import Pitch
from schemas.frames import Point
from schemas.messages.command import Kick, KickMode
from schemas.messages.setup import Setup

RANGE = 8.0
"""m from the goal's middle; no shots from farther away."""
OPEN = 0.5
"""m of free lane that make a shot worth it."""
SHOOT_FROM = 3.2
"""m in front of the goal line, where the ball is carried to."""
PRESSED = 0.9
"""m between the centres; an opponent nearer than this presses."""
RISES = 1.5
"""m after which a lob is above all robots."""
DUEL = 0.6
"""s under pressure after which the ball is knocked on into free ground."""
KNOCK_ON = 3.0
"""m of ground that must be free for it."""
PATIENCE = 2.5
"""s with the ball after which the best available kick is taken."""
PREPARED = 1.0
"""m into the other half; a pass received there makes a goal count."""
SHOT_ERROR = 0.15
"""m beside the target, at most."""


class StrikerSituation(NamedTuple):
    """The input of the striker's decision."""

    me: Body
    mates: Mapping[str, Teammate]
    """Teammates in the field."""
    opponents: Sequence[Point]
    held: float
    """s with the ball."""
    pressed: float
    """s with the ball and an opponent beside it."""
    receiver: str | None
    """The receiver that was chosen a tick ago."""
    may_score: bool = True
    """Whether a goal would count."""
    must_pass: bool = False
    """Whether the rules require this robot to give up the ball soon."""


def play_ball(situation: StrikerSituation, setup: Setup, limits: DriveLimits) -> Action:
    """One tick of a robot that holds the ball."""
    me, pitch = situation.me, setup.pitch
    ball = (me.x + setup.dribble.gap * math.cos(me.heading), me.y + setup.dribble.gap * math.sin(me.heading))
    aim, width = best_place(ball, situation.opponents, pitch)
    far = math.hypot(pitch.goal_line - ball[0], ball[1])
    hurried = situation.held > PATIENCE or situation.must_pass or is_pressed(me, situation.opponents)
    if (
        far < RANGE
        and situation.may_score
        and (width > OPEN or (hurried and _can_lob(ball, aim, situation.opponents, pitch)))
    ):
        return _shoot(situation, (pitch.goal_line, aim), width, setup, limits)
    if situation.pressed > DUEL and _can_knock_on(situation, ball, setup):
        return _knock_on(situation, setup, limits)
    receiver = _receiver(situation, ball, hurried)
    if receiver is not None:
        return _pass(situation, receiver, setup, limits)
    if situation.held > 2.0 * PATIENCE and situation.may_score:
        return _shoot(situation, (pitch.goal_line, aim), width, setup, limits)
    return _carry(situation, setup, limits)


def _receiver(situation: StrikerSituation, ball: Point, hurried: bool) -> str | None:
    """The chosen receiver while its lane stays open; another one, or one behind the ball, only in a hurry."""
    places, has_to = places_of(situation.mates), hurried or not situation.may_score
    chosen = places.get(situation.receiver or "")
    if chosen is not None and (has_to or chosen[0] > ball[0]) and is_open(ball, chosen, situation.opponents, EASE):
        return situation.receiver
    if has_to:
        ahead = {name: place for name, place in places.items() if hurried or place[0] > PREPARED}
        return best_receiver(ball, ahead, situation.opponents, situation.me.heading)
    return None


def is_pressed(me: Body, opponents: Sequence[Point]) -> bool:
    """Whether an opponent is near and not behind."""
    for x, y in opponents:
        dx, dy = x - me.x, y - me.y
        if math.hypot(dx, dy) < PRESSED and dx * math.cos(me.heading) + dy * math.sin(me.heading) > -0.2:
            return True
    return False


def _can_lob(ball: Point, aim: float, opponents: Sequence[Point], pitch: Pitch) -> bool:
    """Whether a lob is possible: no opponent right before the ball, and the goal far enough away."""
    dx, dy = pitch.goal_line - ball[0], aim - ball[1]
    far = math.hypot(dx, dy)
    risen = ball[0] + dx / far * RISES, ball[1] + dy / far * RISES
    return far > 2.0 * RISES and lane_width(ball, risen, opponents) > OPEN


def _can_knock_on(situation: StrikerSituation, ball: Point, setup: Setup) -> bool:
    """Whether the ground ahead of the kick axis is free, on the pitch, and not toward the own goal."""
    heading = situation.me.heading
    end = (ball[0] + KNOCK_ON * math.cos(heading), ball[1] + KNOCK_ON * math.sin(heading))
    is_on_pitch = inside(*end, setup.pitch, 0.0) == end
    return math.cos(heading) > -0.2 and is_on_pitch and lane_width(ball, end, situation.opponents) > OPEN


def _knock_on(situation: StrikerSituation, setup: Setup, limits: DriveLimits) -> Action:
    """Leave a duel: kick the ball past the opponent, and follow it."""
    speed = pass_speed(2.0 * KNOCK_ON, setup, arriving=0.0)
    motion = drive(situation.me, situation.me.vx, situation.me.vy, 0.0, limits)
    kick = Kick(mode=KickMode.GROUND, speed=speed)
    return Action(Role.STRIKER, "knock on", motion, dribble=True, kick=kick)


def _shoot(situation: StrikerSituation, target: Point, width: float, setup: Setup, limits: DriveLimits) -> Action:
    """Shoot along the ground into an open lane, over all robots when there is none."""
    kicker = setup.kicker
    mode, speed = KickMode.GROUND, kicker.max_ground_speed
    if width <= OPEN:
        mode, speed = KickMode.LOB, kicker.max_lob_speed
    motion, kick = kick_at(situation.me, target, speed, SHOT_ERROR, limits, mode)
    return Action(Role.STRIKER, "shoot", motion, dribble=True, kick=kick)


def _pass(situation: StrikerSituation, receiver: str, setup: Setup, limits: DriveLimits) -> Action:
    """Aim and kick; the receiver is set before the kick, too, so that it stays the same."""
    motion, kick = pass_to(situation.me, situation.mates[receiver].body[:2], setup, limits)
    return Action(Role.STRIKER, f"pass to {receiver}", motion, dribble=True, kick=kick, pass_to=receiver)


def _carry(situation: StrikerSituation, setup: Setup, limits: DriveLimits) -> Action:
    """Carry the ball toward the goal, to the place of a shot."""
    me, pitch = situation.me, setup.pitch
    x, y = pitch.goal_line - SHOOT_FROM, 0.4 * me.y
    facing = math.atan2(-me.y, pitch.goal_line - me.x)
    blocked = circles(situation.opponents, 2.0 * setup.robot.reach + setup.ball.radius + 0.15)
    return Action(Role.STRIKER, "carry", dribble_to(me, x, y, facing, blocked, limits), dribble=True)
