"""What a robot of the shipped teams reports: its radio message, and why it does not carry out an order. Pure."""

import math
from collections.abc import Collection

from robot_agent.sdk.world_model import WorldBelief
from robot_agent.teams.action import Action
from schemas.messages.coach import CoachOrder, CoachTest
from schemas.messages.radio import MAX_OBSTACLES, BallBelief, Motion, Radio
from schemas.soccer.game import Point

_MOST = 80
"""Characters of a reason, as of `schemas.wire.message.ShortText`."""


def radio_message(belief: WorldBelief, action: Action) -> Radio:
    """The radio message to the teammates, with the obstacles for the coach, in whole centimetres."""
    me, ball = belief.me, belief.ball
    return Radio(
        self=Motion(x=me.x, y=me.y, heading=me.heading, vx=me.vx, vy=me.vy, omega=me.omega),
        ball=BallBelief(x=ball.now.x, y=ball.now.y, vx=ball.now.vx, vy=ball.now.vy, age=ball.age) if ball else None,
        role=action.role,
        intention=action.intention,
        pass_to=action.pass_to,
        obstacles=[Point(x=round(x, 2), y=round(y, 2)) for x, y in _nearest(belief)],
    )


def _nearest(belief: WorldBelief) -> list[tuple[float, float]]:
    """The opponents and other bodies; of more than a message holds, the nearest."""
    if len(belief.opponents) <= MAX_OBSTACLES:
        return belief.opponents
    return sorted(belief.opponents, key=lambda place: math.dist(place, belief.me[:2]))[:MAX_OBSTACLES]


def why_refused(order: CoachOrder, tests: Collection[CoachTest], tactics: Collection[str]) -> str:
    """Why a robot that knows these tests and tactics does not carry out an order; empty where it does."""
    if order.test is not None and order.test not in tests:
        return f"unknown test: {order.test.value}"
    if order.tactic and order.tactic not in tactics:
        return f"unknown tactic: {order.tactic}"[:_MOST]
    return ""
