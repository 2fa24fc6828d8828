"""What a base station of ours tells the referee box of the world: its robots' own words, where they speak. Pure.

Robots say on the radio where they are and where they see the ball. What a robot has not said lately is taken from the
truth, and so are the opponents, of whom no word is said.
"""

from collections.abc import Mapping
from typing import Any

from schemas.frames import Pose
from schemas.game import GameState
from schemas.league.robot_numbers import numbers_of
from schemas.league.world_state import BallSeen, ObstacleSeen, RobotSeen, world_state
from schemas.messages.command import Radio
from schemas.messages.host import Belief, Setup
from schemas.messages.world import RobotTruth, World
from schemas.side import Side

OLD = 1.0
"""Simulated time in s after which a word no longer counts. Ours: the radio carries one in every tick or every tenth."""
_SURE_FOR = 2.0
"""s since a ball was seen until nobody is sure of it any more. Ours."""


def own_world_state(
    side: Side,
    setup: Setup,
    sides: Mapping[str, Side],
    state: GameState | None,
    world: World,
    beliefs: Mapping[str, Belief],
) -> dict[str, Any]:
    """The league's world state of a side; `beliefs` are the newest words of each robot, in the team frame."""
    attack = side.attack(state.cyan_attacks if state is not None else 1)
    playing = {name: robot for name, robot in world.robots.items() if robot.off_field is None}
    mine = [name for name in playing if sides.get(name) is side]
    words = {name: beliefs[name] for name in mine if name in beliefs and world.time - beliefs[name].time <= OLD}
    numbers = numbers_of(sides)
    ages = [world.time - word.time for word in words.values()]
    obstacles = [
        ObstacleSeen(robot.x, robot.y, robot.vx, robot.vy, setup.robot.radius)
        for name, robot in playing.items()
        if sides.get(name) is side.opponent
    ]
    obstacles += [ObstacleSeen(body.x, body.y, 0.0, 0.0, body.radius) for body in world.obstacles.values()]
    return world_state(
        setup.teams[side].name,
        attack,
        [_robot(numbers[name], playing[name], words.get(name), attack) for name in mine],
        _balls(setup, world, words, attack),
        obstacles,
        age_ms=max(0, round(max(ages, default=0.0) * 1e3)),
    )


def _robot(number: int, truth: RobotTruth, word: Belief | None, attack: int) -> RobotSeen:
    radio = word.radio if word is not None else Radio()
    said = radio.self
    if said is None:
        motion = (truth.x, truth.y, truth.heading, truth.vx, truth.vy, truth.omega)
    else:
        pose = Pose(said.x, said.y, said.heading).team(attack)
        motion = (pose.x, pose.y, pose.heading, attack * said.vx, attack * said.vy, said.omega)
    return RobotSeen(number, *motion, truth.holding, radio.intention or "")


def _balls(setup: Setup, world: World, words: Mapping[str, Belief], attack: int) -> list[BallSeen]:
    """The ball as the robot saw it that saw it last; the true one where nobody of the team speaks at all."""
    if not words:
        ball = world.ball
        return [BallSeen(ball.x, ball.y, ball.z, ball.vx, ball.vy, ball.vz)]
    seen = [(word.radio.ball, world.time - word.time) for word in words.values() if word.radio.ball is not None]
    if not seen:
        return []
    newest, since = min(seen, key=lambda one: one[0].age + one[1])
    confidence = max(0.0, 1.0 - (newest.age + since) / _SURE_FOR)
    place = (attack * newest.x, attack * newest.y, setup.ball.radius)
    return [BallSeen(*place, attack * newest.vx, attack * newest.vy, 0.0, confidence)]
