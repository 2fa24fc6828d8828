"""The goalkeeper with the ball: which ball it leaves its line for, how it fetches it, and where it plays it. Pure."""

import math

from robot_agent.sdk.bodies import Ball, DriveLimits
from robot_agent.sdk.skills.keep_out import Area
from robot_agent.sdk.world_model import WorldBelief
from robot_agent.soccer.skills.intercept import meet, way_of
from robot_agent.soccer.skills.pass_to import best_receiver, pass_to
from robot_agent.soccer.skills.take_ball import take_ball
from robot_agent.teams.action import Action
from schemas.config.rolling import Rolling
from schemas.messages.command import Drive
from schemas.messages.setup import Setup

CLEAR = "clear"
"""Intention of a keeper that leaves its line for the ball."""
SLOW = 1.5
"""m/s; a faster ball may be a shot, for which the keeper stays on its line."""
_WING = 0.4
"""Share of the pitch's width between its middle and the wing that the ball is played up to."""


def is_keepers_ball(belief: WorldBelief, ball: Ball, setup: Setup) -> bool:
    """Whether a slow ball is in the own penalty area, with no opponent nearer to it."""
    if not Area.penalty(setup.pitch).has(-1.0, ball.x, ball.y) or math.hypot(ball.vx, ball.vy) > SLOW:
        return False
    away = math.dist(ball[:2], belief.me[:2])
    return all(math.dist(ball[:2], opponent) > away for opponent in belief.opponents)


def fetch(belief: WorldBelief, ball: Ball, setup: Setup, limits: DriveLimits) -> Drive:
    """Drive to the ball and take it, around all other robots."""
    gap, clearance = setup.dribble.gap, 2.0 * setup.robot.reach + 0.05
    meeting = meet(belief.me, way_of(ball, Rolling.of(setup.ball)), gap, limits)
    mates = [mate.body[:2] for mate in belief.mates.values()]
    return take_ball(belief.me, ball, meeting, gap, belief.opponents, clearance, limits, mates)


def play_out(belief: WorldBelief, chosen: str | None, setup: Setup, limits: DriveLimits) -> tuple[Action, str | None]:
    """Pass to a teammate, or far up the wing that the ball is on; the action without its role, and the receiver."""
    mates = {name: mate.body[:2] for name, mate in belief.mates.items()}
    receiver = best_receiver(belief.me[:2], mates, belief.opponents, chosen=chosen)
    up_the_wing = 0.0, math.copysign(_WING * setup.pitch.width, belief.me.y)
    target = mates[receiver] if receiver is not None else up_the_wing
    motion, kick = pass_to(belief.me, target, setup, limits)
    return Action("", CLEAR, motion, True, kick, receiver if kick is not None else None), receiver
