"""The robot that holds the ball: shoot, pass, or dribble, whichever is worth most. Pure."""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.skills.avoid import circles, steer
from robot_agent.sdk.skills.go_to import drive
from robot_agent.sdk.skills.turn_to import turn_rate
from robot_agent.soccer.skills.kick_on_the_run import kick_on_the_run
from robot_agent.teams.action import Action
from robot_agent.teams.reference.clearing import best_clear
from robot_agent.teams.reference.parameters import Parameters
from robot_agent.teams.reference.passing import Pass, chance, cost_of_loss, passes, worth
from robot_agent.teams.reference.roles import Role
from robot_agent.teams.reference.shooting import Shot, best_shot, shot_ahead
from schemas.config.sections import Pitch
from schemas.frames import Point
from schemas.messages.command import Kick, KickMode
from schemas.messages.setup import Setup

_WAYS = tuple(math.radians(angle) for angle in (0, 25, -25, 50, -50, 80, -80))
"""Directions of a dribble, from the kick axis's way to the goal."""


class Situation(NamedTuple):
    """What the robot with the ball decides by."""

    me: Body
    mates: Mapping[str, Body]
    """Teammates in the field."""
    opponents: Sequence[Point]
    held: float
    """s with the ball."""
    chosen: tuple[str, Point] | None
    """The pass that was chosen a tick ago."""
    may_score: bool
    must_pass: bool
    aimed: Shot | None = None
    """The shot that it aimed at a tick ago."""


class Choice(NamedTuple):
    """What the robot with the ball does, and why."""

    action: Action
    aimed: Pass | None
    """The pass that it aims at."""
    weighed: dict[str, float]
    """Chance of the best shot, values of the best pass and of the best dribble."""
    shot: Shot | None = None
    """The shot that it aims at."""


def play_ball(now: Situation, setup: Setup, limits: DriveLimits, parameters: Parameters) -> Choice:
    """One tick with the ball."""
    me, pitch = now.me, setup.pitch
    gap = setup.dribble.gap
    ball = me.x + gap * math.cos(me.heading), me.y + gap * math.sin(me.heading)
    shot = best_shot(ball, me.heading, now.opponents, pitch, parameters, now.aimed) if now.may_score else None
    best = _best_pass(now, ball, pitch, parameters)
    way, dribble_worth = _best_dribble(now, ball, pitch, parameters)
    weighed = {
        "shot": shot.chance if shot is not None else 0.0,
        "pass": best.value if best is not None else 0.0,
        "dribble": dribble_worth,
    }
    is_late = now.held > parameters.patience or now.must_pass
    if shot is not None and shot.chance > _least_chance(now, ball, parameters, is_late=is_late):
        return Choice(_shoot(now, ball, shot, setup, limits, parameters), None, weighed, shot)
    if ball[0] < parameters.clears_before:
        if best is None and (is_late or _is_pressed(now, ball, parameters.clear_pressed)):
            best = best_clear(ball, me.heading, now.opponents, pitch, parameters)
        if best is not None:
            return Choice(_pass(now, ball, best, setup, limits, parameters), best, weighed)
    if best is not None and (best.value > dribble_worth or (is_late and best.chance > parameters.pass_late)):
        return Choice(_pass(now, ball, best, setup, limits, parameters), best, weighed)
    return Choice(_dribble(now, way, setup, limits, parameters), None, weighed)


def _least_chance(now: Situation, ball: Point, parameters: Parameters, *, is_late: bool) -> float:
    """The chance of a goal from which the robot shoots: what it has begun it ends, and with room it goes closer."""
    if is_late:
        return parameters.shot_late
    if now.aimed is not None:
        return parameters.shot_keeps
    return parameters.shot_worth if _is_pressed(now, ball, parameters.shot_pressed) else parameters.shot_waits


def _is_pressed(now: Situation, ball: Point, within: float) -> bool:
    """Whether an opponent is so near to the ball, m."""
    return any(math.dist(ball, opponent) < within for opponent in now.opponents)


def _best_pass(now: Situation, ball: Point, pitch: Pitch, parameters: Parameters) -> Pass | None:
    """The pass of the highest value; where a goal would not count, passes into the other half are worth more."""
    found = passes(ball, now.me.heading, now.mates, now.opponents, now.chosen, pitch, parameters)
    if not now.may_score:
        bonus = parameters.pass_prepares
        found = [
            one._replace(value=one.value + bonus * one.chance * (one.target[0] > parameters.prepared)) for one in found
        ]
    return max(found, key=lambda one: one.value, default=None)


def _best_dribble(now: Situation, ball: Point, pitch: Pitch, parameters: Parameters) -> tuple[float, float]:
    """The best direction to carry the ball, rad, and its value."""
    to_goal = math.atan2(-ball[1], pitch.goal_line - parameters.dribble_aims - ball[0])
    best, most, step = to_goal, -math.inf, parameters.dribble_step
    pressed = _is_pressed(now, ball, parameters.pressed)
    for turn in _WAYS:
        way = to_goal + turn
        end = ball[0] + step * math.cos(way), ball[1] + step * math.sin(way)
        beside, before = pitch.touch_line - abs(end[1]), pitch.goal_line - end[0]
        if beside < parameters.dribble_beside or before < parameters.dribble_before:
            continue
        sure = chance(ball, end, now.opponents, parameters)
        value = sure * worth(end, now.opponents, pitch, parameters) - (1.0 - sure) * cost_of_loss(
            end, pitch, parameters
        )
        value -= parameters.dribble_turn_cost * abs(turn)
        if value > most:
            best, most = way, value
    return best, most - (parameters.pressed_cost if pressed else 0.0)


def _shoot(
    now: Situation, ball: Point, shot: Shot, setup: Setup, limits: DriveLimits, parameters: Parameters
) -> Action:
    """Turn to the target while driving on, and kick once the ball would score nearly as surely where it points."""
    me, kicker = now.me, setup.kicker
    speed = kicker.max_lob_speed if shot.mode is KickMode.LOB else kicker.max_ground_speed
    velocity = _toward(me, shot.target, parameters.shot_drive * parameters.dribble_speed)
    motion, kick = kick_on_the_run(me, shot.target, speed, parameters.shot_error, velocity, limits, shot.mode)
    if kick is None and shot.mode is KickMode.GROUND:
        ahead = shot_ahead(ball, me.heading + me.omega * limits.tick, now.opponents, setup.pitch, parameters)
        if ahead is not None and ahead.chance > parameters.shot_takes * shot.chance:
            kick = Kick(mode=shot.mode, speed=speed)
    return Action(Role.ATTACKER, f"shoot {shot.mode.value}", motion, dribble=True, kick=kick)


def _pass(now: Situation, ball: Point, best: Pass, setup: Setup, limits: DriveLimits, parameters: Parameters) -> Action:
    """Aim while turning; a pass arrives as fast as a dribbler keeps it."""
    speed, error = best.strength(ball, setup, parameters)
    velocity = _toward(now.me, best.target, parameters.pass_drive * parameters.dribble_speed)
    motion, kick = kick_on_the_run(now.me, best.target, speed, error, velocity, limits)
    intention = f"pass to {best.receiver}" if best.receiver else "kick away"
    pass_to = best.receiver or None if kick is not None else None
    return Action(Role.ATTACKER, intention, motion, dribble=True, kick=kick, pass_to=pass_to)


def _dribble(now: Situation, way: float, setup: Setup, limits: DriveLimits, parameters: Parameters) -> Action:
    """Carry the ball round opponents, its front toward where it goes: backward driving is limited by the rules."""
    me, slow = now.me, limits.capped(parameters.dribble_speed, parameters.turn_rate)
    blocked = circles(now.opponents, 2.0 * setup.robot.reach + setup.ball.radius + parameters.dribble_room)
    ahead = max(0.25, math.cos(way - me.heading))
    speed = parameters.dribble_speed * ahead * (parameters.dribble_ends if now.must_pass else 1.0)
    vx, vy = steer(me, speed * math.cos(way), speed * math.sin(way), parameters.dribble_step, blocked)
    facing = math.atan2(vy, vx)
    return Action(Role.ATTACKER, "dribble", drive(me, vx, vy, turn_rate(me, facing, slow), slow), dribble=True)


def _toward(me: Body, target: Point, speed: float) -> Point:
    away = max(math.dist(me[:2], target), 1e-6)
    return speed * (target[0] - me.x) / away, speed * (target[1] - me.y) / away
