import math
import random

import pytest
from msgspec.structs import replace

from robot_agent.sdk.bodies import Ball
from robot_agent.sdk.opponents import REMEMBERED
from robot_agent.sdk.world_model import LOST, STALE, WorldModel
from schemas.config.profile import load_profile
from schemas.config.rolling import Rolling
from schemas.messages.radio import BallBelief
from schemas.messages.sight import BallSight, Motion, ReceivedRadio
from schemas.soccer.game import Point, TeamPhase

ROLLING = Rolling.of(load_profile("msl").ball)


@pytest.fixture
def world(briefing):
    return WorldModel(briefing)


def word(x, y, age=0.0, ball=None, vx=0.0, **more):
    return ReceivedRadio(age=age, self=Motion(x=x, y=y, heading=0.0, vx=vx), ball=ball, **more)


def test_a_first_sight_is_believed_as_it_is(world, sight_of):
    belief = world.update(sight_of(at=(1.0, 2.0, 0.5), ball=(3.0, 4.0, 1.0, 0.0)))
    assert belief.me[:3] == (1.0, 2.0, 0.5)
    assert belief.ball.now == (3.0, 4.0, 1.0, 0.0)
    assert belief.dt == 0.0


def test_time_between_sights_is_measured_not_assumed(world, sight_of):
    world.update(sight_of(10))
    assert world.update(sight_of(13)).dt == pytest.approx(0.06)


def test_noise_is_smoothed_to_less_than_its_size(world, sight_of):
    noise = random.Random(1)
    errors = []
    for tick in range(200):
        ball = (3.0 + noise.gauss(0, 0.03), noise.gauss(0, 0.03), noise.gauss(0, 0.1), noise.gauss(0, 0.1))
        belief = world.update(sight_of(tick, at=(noise.gauss(0, 0.02), 0.0, 0.0), ball=ball))
        errors.append((abs(belief.ball.now.x - 3.0), abs(belief.me.x)))
    ball_error, own_error = (sum(column) / 200 for column in zip(*errors, strict=True))
    assert ball_error < 0.7 * 0.03 * math.sqrt(2 / math.pi)
    assert own_error < 0.7 * 0.02 * math.sqrt(2 / math.pi)


def test_a_kick_and_a_robot_set_down_elsewhere_are_believed_at_once(world, sight_of):
    world.update(sight_of(0, ball=(3.0, 0.0)))
    belief = world.update(sight_of(1, at=(-5.0, 0.0, 3.0), ball=(3.2, 0.0, 10.0, 0.0)))
    assert belief.ball.now.vx == 10.0
    assert (belief.me.x, belief.me.heading) == (-5.0, 3.0)


def test_a_held_ball_is_before_the_robot(world, sight_of, setup):
    ball = world.update(sight_of(at=(1.0, 1.0, math.pi / 2), ball=(9.0, 9.0), holding=True)).ball
    assert ball.now[:2] == pytest.approx((1.0, 1.0 + setup.dribble.gap))
    assert ball.age == 0.0


def test_an_unseen_ball_is_where_the_teammate_that_saw_it_last_believes_it_extrapolated_since_its_message(
    world, sight_of
):
    own = BallSight(x=5.0, y=5.0, vx=0.0, vy=0.0, age=3.0, visible=False)
    radio = {
        "cyan3": word(0.0, 0.0, 0.1, BallBelief(x=1.0, y=0.0, vx=2.0, vy=0.0, age=0.4)),
        "cyan4": word(0.0, 0.0, 0.1, BallBelief(x=-7.0, y=0.0, age=1.5)),
    }
    ball = world.update(sight_of(ball=own, radio=radio)).ball
    assert ball.age == pytest.approx(0.5)
    assert ball.now.x == pytest.approx(Ball(1.0, 0.0, 2.0, 0.0).after(0.1, ROLLING).x)


def test_an_own_ball_in_sight_is_believed_before_any_teammates(world, sight_of):
    radio = {"cyan3": word(0.0, 0.0, 0.0, BallBelief(x=-7.0, y=0.0))}
    assert world.update(sight_of(ball=(3.0, 0.0), radio=radio)).ball.now.x == 3.0


def test_a_picture_is_extrapolated_by_its_age_and_a_repeated_one_adds_nothing(world, sight_of):
    seen = BallSight(x=2.0, y=0.0, vx=3.0, vy=0.0, age=0.02)
    first = world.update(sight_of(5, ball=seen)).ball.now
    assert first.x == pytest.approx(2.0 + 3.0 * 0.02, abs=1e-3)
    again = world.update(sight_of(6, ball=replace(seen, age=0.04))).ball.now
    assert again == pytest.approx(Ball(*first).after(0.02, ROLLING))


def test_a_ball_just_lost_rolls_on_before_any_teammates_word_counts(world, sight_of):
    lost = BallSight(x=2.0, y=0.0, vx=3.0, vy=0.0, age=0.15, visible=False)
    radio = {"cyan3": word(0.0, 0.0, 0.02, BallBelief(x=-7.0, y=0.0))}
    assert world.update(sight_of(ball=lost, radio=radio)).ball.now.x == pytest.approx(2.45, abs=0.01)


def test_a_ball_not_seen_for_long_is_nowhere_in_play_and_on_its_spot_at_a_restart(world, sight_of):
    lost = BallSight(x=2.0, y=0.0, vx=0.0, vy=0.0, age=LOST + 0.1, visible=False)
    assert world.update(sight_of(0, ball=lost)).ball is None
    spot = Point(x=-4.0, y=3.0)
    there = world.update(sight_of(1, ball=lost, phase=TeamPhase.THEIR_FREE_KICK, running=False, spot=spot)).ball
    assert there.now[:2] == (-4.0, 3.0)


def test_an_opponent_is_remembered_for_a_while_when_it_is_hidden_or_overlooked(world, sight_of):
    assert world.update(sight_of(0, obstacles=((3.0, 1.0),))).opponents == [(3.0, 1.0)]
    assert world.update(sight_of(10)).opponents == [(3.0, 1.0)]
    assert world.update(sight_of(10 + round(REMEMBERED / 0.02) + 1)).opponents == []


def test_a_moving_opponent_is_moved_on_by_the_age_of_the_picture(world, sight_of):
    """At 2 m/s, pictures of 25 Hz that come a tick late: the estimate is within 3 cm of the truth, not 4 cm behind."""
    for tick in range(60):
        pictured = tick // 2 * 2 - 1
        at = ((1.0 + 2.0 * 0.02 * pictured, 1.0),)
        belief = world.update(sight_of(tick, obstacles=at, obstacles_age=0.02 * (tick - pictured)))
    ((x, y),) = belief.opponents
    assert x == pytest.approx(1.0 + 2.0 * 0.02 * 59, abs=0.03)
    assert y == 1.0


def test_a_ball_that_no_robot_has_seen_is_none(world, sight_of):
    assert world.update(sight_of(ball=None)).ball is None


def test_teammates_are_moved_on_by_the_age_of_their_word_and_forgotten_when_it_is_stale(world, sight_of):
    radio = {"cyan3": word(1.0, 0.0, 0.1, vx=2.0, role="striker"), "cyan4": word(0.0, 0.0, STALE + 0.01)}
    mates = world.update(sight_of(radio=radio)).mates
    assert list(mates) == ["cyan3"]
    assert mates["cyan3"].body.x == pytest.approx(1.2)
    assert mates["cyan3"].role == "striker"


def test_opponents_are_the_obstacles_that_no_teammate_accounts_for(world, sight_of):
    radio = {"cyan3": word(1.0, 0.0, 0.1, vx=2.0), "cyan4": word(-3.0, 0.0)}
    obstacles = ((1.25, 0.1), (-3.0, 0.6), (4.0, 4.0))
    assert world.update(sight_of(obstacles=obstacles, radio=radio)).opponents == [(-3.0, 0.6), (4.0, 4.0)]


def test_an_opponent_beside_a_teammate_stays_an_opponent(world, sight_of):
    obstacles = ((1.45, 0.0), (1.0, 0.02))
    assert world.update(sight_of(obstacles=obstacles, radio={"cyan3": word(1.0, 0.0)})).opponents == [(1.45, 0.0)]
