"""Turning and braking with the ball, in the physics of profile `msl`, and the limits one by one."""

import dataclasses
import math

import pytest

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.world_model import WorldModel
from robot_agent.soccer.skills.keep_hold import keep_hold
from robot_agent.soccer.skills.kick_on_the_run import kick_on_the_run
from schemas.frames import wrap
from schemas.messages.command import Command, Drive
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from support.lone_robot import briefing_of, one_robot_and_a_ball
from touchline.play.play_match import InProcessMatch

TICK = 0.02


class Turner:
    """Drives at the ball, and once it holds it turns to a heading and brakes."""

    def __init__(self, briefing: Briefing, speed: float, heading: float, *, gently: bool) -> None:
        self._setup, self._limits = briefing.setup, DriveLimits.of(briefing.setup)
        self._world = WorldModel(briefing)
        self._speed, self._heading, self._gently = speed, heading, gently
        self._last = Drive()
        self.held = 0.0
        self.lost = self.turned = False

    def act(self, sight: Sight) -> Command:
        """The answer to one sight."""
        belief = self._world.update(sight)
        me, motion = belief.me, Drive(vx=self._speed)
        self.lost = self.lost or (self.held > 0.0 and not belief.holding)
        if belief.holding and not self.lost:
            self.held += belief.dt
            self.turned = abs(wrap(self._heading - me.heading)) < 0.1
            target = me.x + 5.0 * math.cos(self._heading), me.y + 5.0 * math.sin(self._heading)
            motion, _ = kick_on_the_run(me, target, 5.0, 0.1, (0.0, 0.0), self._limits)
            if self._gently:
                motion = keep_hold(me, motion, self._last, belief.dt, self._setup)
        self._last = motion
        return Command(answers_tick=sight.tick, drive=motion, dribble=True)


def turn(speed: float, heading: float, *, gently: bool) -> Turner:
    """A turn with the ball from a speed; ends with the turn, or when the ball is lost."""
    config = one_robot_and_a_ball(-6.0, -2.0)
    turner = Turner(briefing_of(config), speed, heading, gently=gently)
    match = InProcessMatch(config, {"cyan2": turner})
    while match.simulation.now.time < 7.0 and not (turner.lost or turner.turned):
        match.step()
    match.close()
    return turner


@pytest.mark.parametrize("speed", [2.0, 3.0])
@pytest.mark.parametrize("heading", [math.pi / 2, -2.4])
def test_a_robot_that_turns_while_it_brakes_keeps_the_ball(speed: float, heading: float) -> None:
    turner = turn(speed, heading, gently=True)
    assert turner.turned
    assert turner.held < 1.6


def test_the_same_turn_at_full_braking_loses_the_ball() -> None:
    assert turn(2.0, math.pi / 2, gently=False).lost


def test_a_straight_brake_stays_below_the_pull_of_the_dribbler(setup: Setup) -> None:
    kept = keep_hold(Body(0.0, 0.0, 0.0, 3.0), Drive(), Drive(vx=3.0), TICK, setup)
    pull = setup.dribble.max_pull / (setup.ball.mass + setup.ball.inertia / setup.ball.radius**2)
    assert 3.0 - pull * TICK < kept.vx < 3.0


def test_the_faster_the_turn_the_softer_the_brake(setup: Setup) -> None:
    me, last = Body(0.0, 0.0, 0.0, 2.0), Drive(vx=2.0)
    speeds = [keep_hold(me, Drive(omega=omega), last, TICK, setup).vx for omega in (0.0, 1.5, 2.5)]
    assert speeds == sorted(speeds)
    assert speeds[0] < speeds[-1]


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_turn_is_one_around_the_ball_and_slower_at_speed(setup: Setup, side: float) -> None:
    rest = keep_hold(Body(0.0, 0.0, 0.0), Drive(omega=3.0 * side), Drive(), TICK, setup)
    fast = keep_hold(Body(0.0, 0.0, 0.0, 4.0), Drive(vx=4.0, omega=5.0 * side), Drive(vx=4.0), TICK, setup)
    assert rest.omega == 3.0 * side
    assert rest.vy * side < 0.0
    assert abs(fast.omega) < 3.0


def test_without_bounded_forces_the_drive_is_the_wanted_one(setup: Setup) -> None:
    unbounded = setup.replace(dribble=dataclasses.replace(setup.dribble, method="pose"))
    wanted = Drive(vx=-1.0, omega=6.0)
    assert keep_hold(Body(0.0, 0.0, 0.0, 2.0), wanted, Drive(vx=2.0), TICK, unbounded) is wanted
