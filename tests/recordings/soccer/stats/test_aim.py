"""Where a ball is going, against closed forms."""

import math

import pytest

from recordings.soccer.stats.aim import NEAR_MISS_M, Aim, aim
from schemas.config.rolling import GRAVITY
from schemas.config.soccer.kicked import Kicked
from schemas.messages.world import BallTruth

HALF_GOAL_LINE = 11.0


def ball(x=0.0, y=0.0, z=0.11, vx=0.0, vy=0.0, vz=0.0) -> BallTruth:
    return BallTruth(x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)


@pytest.fixture
def aimed(script):
    return lambda attack=1, **state: aim(ball(**state), attack, script.setup)


@pytest.fixture
def pitch(script):
    return script.setup.pitch


def test_the_post_is_the_edge_of_the_goal_and_a_metre_beside_it_of_the_shot(aimed, pitch) -> None:
    for beside, expected in ((-0.01, Aim.AT_GOAL), (0.01, Aim.PAST_GOAL), (NEAR_MISS_M + 0.01, Aim.ELSEWHERE)):
        y = pitch.goal_width / 2 + beside
        slope = y / pitch.goal_line
        for sign in (-1, 1):
            assert aimed(vx=9.0, vy=sign * 9.0 * slope) is expected


def test_away_from_the_goal_and_behind_the_line_is_elsewhere(aimed) -> None:
    assert aimed(vx=-9.0) is Aim.ELSEWHERE
    assert aimed(vx=-9.0, attack=-1) is Aim.AT_GOAL
    assert aimed(x=11.2, vx=9.0) is Aim.ELSEWHERE
    assert aimed(vy=9.0) is Aim.ELSEWHERE


def test_a_ball_that_comes_to_rest_before_the_line_is_not_aimed_at_it(aimed, script) -> None:
    """A ball that flies first and loses a + k·v² in m/s² rolls ln(1 + k·v²/a) / 2k; a kicked one slides first."""
    ball, distance = script.setup.ball, script.setup.pitch.goal_line
    area = math.pi * ball.radius**2
    k = 0.5 * ball.air_density * ball.rolling_drag_coefficient * area / (ball.mass + ball.inertia / ball.radius**2)
    enough = math.sqrt(ball.rolling_deceleration * (math.exp(2 * k * distance) - 1) / k)
    assert aimed(vx=1.01 * enough, vz=0.5) is Aim.AT_GOAL
    assert aimed(vx=0.99 * enough, vz=0.5) is Aim.ELSEWHERE
    slides = Kicked.of(ball, script.setup.kicker).speed_to_arrive(0.0, distance)
    assert slides > 1.5 * enough
    assert aimed(vx=1.01 * slides) is Aim.AT_GOAL
    assert aimed(vx=0.99 * slides) is Aim.ELSEWHERE


def test_a_lob_is_over_the_bar_while_it_flies_and_below_it_when_it_has_landed(aimed, pitch) -> None:
    """After t = d/vx it is at z + vz·t − g·t²/2."""
    time = 4.0 / 8.0
    for height, expected in ((pitch.goal_height - 0.02, Aim.AT_GOAL), (pitch.goal_height + 0.02, Aim.PAST_GOAL)):
        vz = (height - 0.11 + GRAVITY / 2 * time**2) / time
        assert aimed(x=7.0, vx=8.0, vz=vz) is expected
    assert aimed(x=0.0, vx=8.0, vz=3.0) is Aim.AT_GOAL


@pytest.mark.parametrize("vz", [0.0, 3.0])
def test_a_ball_along_the_goal_line_is_elsewhere(aimed, vz: float) -> None:
    """Its way to the line was too long for a number, and the figures of the whole match were lost."""
    assert aimed(vx=1e-6, vy=9.0, vz=vz) is Aim.ELSEWHERE
