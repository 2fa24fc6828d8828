"""Letting the ball go: soft, ahead, and only where there is room."""

import math

import pytest

from robot_agent.sdk.bodies import Body
from robot_agent.sdk.contract import Briefing
from robot_agent.soccer.skills.let_go import AHEAD, faster, let_go
from schemas.messages.command import Command, Drive
from schemas.messages.sight import Sight
from support.lone_robot import briefing_of, one_robot_and_a_ball
from touchline.play.play_match import InProcessMatch


class LetsGo:
    """Drives at a constant speed through a ball, and lets it go once after 0.3 s with it."""

    def __init__(self, briefing: Briefing, speed: float) -> None:
        self._setup, self._speed = briefing.setup, speed
        self._held = 0.0
        self.let_go_at: float | None = None

    def act(self, sight: Sight) -> Command:
        """The answer to one sight."""
        self._held += 0.02 if sight.holding else 0.0
        kick = None
        if self._held > 0.3 and self.let_go_at is None:
            kick, self.let_go_at = let_go(sight.self, (), self._setup), sight.time
        open_hand = self.let_go_at is not None and kick is None and sight.time < self.let_go_at + 0.4
        return Command(answers_tick=sight.tick, drive=Drive(vx=self._speed), dribble=not open_hand, kick=kick)


@pytest.mark.parametrize("speed", [1.5, 3.0])
def test_a_ball_that_slides_after_the_kick_is_visibly_released_and_caught_again(speed):
    config = one_robot_and_a_ball(-9.0, -6.5)
    briefing = briefing_of(config)
    setup, brain = briefing.setup, LetsGo(briefing, speed)
    match, air, again = InProcessMatch(config, {"cyan2": brain}), 0.0, False
    while match.simulation.now.time < 7.0 and not again:
        world = match.step().world
        if brain.let_go_at is not None:
            gone = world["ball"]["x"] - world["robots"]["cyan2"]["x"] - setup.robot.radius - setup.ball.radius
            air = max(air, gone)
            again = world["time"] > brain.let_go_at + 0.4 and world["possession"] == "cyan2"
    match.close()
    assert air > setup.handling.release_gap + 0.03
    assert air < 0.8


def test_the_ball_gets_a_little_more_speed_than_the_robot_has_toward_it(setup):
    assert let_go(Body(0.0, 0.0, 0.0, 2.0, 0.5), (), setup).speed == pytest.approx(2.0 + faster(setup))
    assert let_go(Body(0.0, 0.0, 0.0, -2.0, 0.0), (), setup).speed == pytest.approx(faster(setup))


@pytest.mark.parametrize(("me", "opponents"), [(Body(0.0, 0.0, 0.0), [(1.5, 0.2)]), (Body(10.0, 5.0, 0.0), [])])
def test_not_into_an_opponent_and_not_off_the_pitch(setup, me, opponents):
    assert let_go(me, opponents, setup) is None


def test_not_beside_an_opponent_that_would_be_at_the_ball_first(setup):
    me = Body(0.0, 0.0, 0.0)
    assert let_go(me, [(setup.dribble.gap, 0.7)], setup) is None
    assert let_go(me, [(setup.dribble.gap, 0.9)], setup) is not None


def test_a_fast_robot_keeps_a_ball_that_would_be_over_the_line_before_it_has_it_again(setup):
    slow, fast = (Body(0.0, 4.5, 0.5 * math.pi, 0.0, speed) for speed in (0.0, 2.0))
    assert let_go(slow, (), setup) is not None
    assert let_go(fast, (), setup) is None


def test_an_opponent_beside_the_path_is_no_hindrance(setup):
    assert let_go(Body(0.0, 0.0, 0.0), [(0.5 * AHEAD, 1.0)], setup) is not None


def test_a_ball_that_slides_gets_more_speed_than_one_that_rolls_at_once(setup, paper_setup):
    assert setup.kicker.kick_spin == 0.0
    assert paper_setup.kicker.kick_spin == 1.0
    assert faster(setup) > faster(paper_setup)
