"""A robot with the ball brakes before the ball is over a line."""

import math

import pytest

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.soccer.skills.keep_in_play import keep_in_play
from schemas.messages.command import Drive
from schemas.messages.setup import Setup

AHEAD = Drive(vx=3.0)


def braked(setup: Setup, x: float, y: float, degrees: float) -> Drive:
    """The demand of a robot that drives ahead at 3 m/s with the ball before it."""
    heading = math.radians(degrees)
    ball = x + setup.dribble.gap * math.cos(heading), y + setup.dribble.gap * math.sin(heading)
    return keep_in_play(Body(x, y, heading), ball, AHEAD, setup, DriveLimits.of(setup))


@pytest.mark.parametrize(("x", "y", "degrees"), [(0.0, 6.2, 90), (0.0, -6.2, -90), (-10.2, 3.0, 180), (10.2, 3.0, 0)])
def test_it_brakes_before_each_line(setup: Setup, x: float, y: float, degrees: float) -> None:
    assert 0.0 < braked(setup, x, y, degrees).vx < 1.6


@pytest.mark.parametrize(("x", "y", "degrees"), [(0.0, 0.0, 90), (0.0, 6.2, -90), (0.0, 6.2, 0), (10.2, 0.3, 0)])
def test_it_drives_on_away_from_lines_along_them_and_into_the_opponents_goal(
    setup: Setup, x: float, y: float, degrees: float
) -> None:
    assert braked(setup, x, y, degrees) == pytest.approx(AHEAD, abs=1e-9)


def test_only_the_speed_over_the_line_is_taken_away(setup: Setup) -> None:
    motion = braked(setup, 0.0, 6.2, 45)
    heading = math.radians(45)
    along = math.cos(heading) * motion.vx - math.sin(heading) * motion.vy
    outward = math.sin(heading) * motion.vx + math.cos(heading) * motion.vy
    assert along == pytest.approx(3.0 * math.cos(heading), abs=0.05)
    assert outward < 1.6
