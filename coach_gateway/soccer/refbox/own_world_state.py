"""The world state that a base station of ours sends to the referee box, from its robots' own beliefs. Pure.

Robots send on the radio where they are, and where they believe the ball and the obstacles to be. What no robot has sent
lately is taken from the truth.
"""

from collections.abc import Mapping
from typing import Any

from coach_gateway.match.team_obstacles import OLD, team_obstacles
from schemas.frames import Pose
from schemas.messages.radio import Belief, Radio
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameState
from schemas.messages.soccer.league.robot_numbers import numbers_of
from schemas.messages.soccer.league.world_state import BallSeen, ObstacleSeen, RobotSeen, true_obstacles, world_state
from schemas.messages.world import RobotTruth, World
from schemas.side import Side

_SURE_FOR = 2.0
"""s since a ball was seen after which its confidence is 0. Chosen here."""


def own_world_state(
    side: Side,
    setup: Setup,
    sides: Mapping[str, Side],
    state: GameState | None,
    world: World,
    beliefs: Mapping[str, Belief],
) -> dict[str, Any]:
    """The league's world state of a side; `beliefs` are the newest of each robot, in the team frame."""
    attack = side.attack(state.cyan_attacks if state is not None else 1)
    playing = {name: robot for name, robot in world.robots.items() if robot.off_field is None}
    mine = [name for name in playing if sides.get(name) is side]
    recent = {name: beliefs[name] for name in mine if name in beliefs and world.time - beliefs[name].time <= OLD}
    numbers = numbers_of(sides)
    ages = [world.time - belief.time for belief in recent.values()]
    return world_state(
        setup.teams[side].name,
        attack,
        [_robot(numbers[name], playing[name], recent.get(name), attack) for name in mine],
        _balls(setup, world, recent, attack),
        _believed_obstacles(setup, recent, world.time, attack)
        or true_obstacles(side, setup.robot.radius, sides, world),
        age_ms=max(0, round(max(ages, default=0.0) * 1e3)),
    )


def _believed_obstacles(setup: Setup, beliefs: Mapping[str, Belief], time: float, attack: int) -> list[ObstacleSeen]:
    """Opponents and other bodies as the team's robots have sent them; their size is taken to be a robot's."""
    return [
        ObstacleSeen(attack * one.x, attack * one.y, 0.0, 0.0, setup.robot.radius)
        for one in team_obstacles(beliefs, time)
    ]


def _robot(number: int, truth: RobotTruth, belief: Belief | None, attack: int) -> RobotSeen:
    radio = belief.radio if belief is not None else Radio()
    own = radio.self
    if own is None:
        motion = (truth.x, truth.y, truth.heading, truth.vx, truth.vy, truth.omega)
    else:
        pose = Pose(own.x, own.y, own.heading).team(attack)
        motion = (pose.x, pose.y, pose.heading, attack * own.vx, attack * own.vy, own.omega)
    return RobotSeen(number, *motion, truth.holding, radio.intention or "")


def _balls(setup: Setup, world: World, beliefs: Mapping[str, Belief], attack: int) -> list[BallSeen]:
    """The ball as last seen by any robot; the true ball, if there is one, where no robot of the team sends anything."""
    if not beliefs:
        ball = world.ball
        return [BallSeen(ball.x, ball.y, ball.z, ball.vx, ball.vy, ball.vz)] if ball is not None else []
    seen = [(one.radio.ball, world.time - one.time) for one in beliefs.values() if one.radio.ball is not None]
    if not seen:
        return []
    newest, since = min(seen, key=lambda one: one[0].age + one[1])
    confidence = max(0.0, 1.0 - (newest.age + since) / _SURE_FOR)
    place = (attack * newest.x, attack * newest.y, setup.ball.radius)
    return [BallSeen(*place, attack * newest.vx, attack * newest.vy, 0.0, confidence)]
