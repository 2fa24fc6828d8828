import pytest

from robot_agent.sdk.bodies import Ball, Body
from robot_agent.teams.simple.formation import places
from robot_agent.teams.simple.roles import STAYS, Candidate, Role, share_places, striker_of
from schemas.config.rolling import Rolling


def at(x, y, role="", **more):
    return Candidate(Body(x, y, 0.0), role, **more)


@pytest.fixture
def pick(limits):
    return lambda candidates, ball=(0.0, 0.0): striker_of(candidates, Ball(*ball), Rolling(0.5), 0.35, limits)


def test_the_robot_that_is_first_at_the_ball_is_the_striker(pick):
    assert pick({"a": at(-4.0, 0.0), "b": at(2.0, 1.0), "c": at(0.0, 5.0)}) == "b"


def test_of_two_equally_near_the_name_decides_whatever_their_order(pick):
    assert pick({"b": at(-2.0, 0.0), "a": at(2.0, 0.0)}) == pick({"a": at(2.0, 0.0), "b": at(-2.0, 0.0)}) == "a"


def test_a_striker_stays_striker_until_another_is_clearly_earlier(pick):
    assert pick({"a": at(-2.2, 0.0, Role.STRIKER), "b": at(2.0, 0.0)}) == "a"
    assert pick({"a": at(-4.0, 0.0, Role.STRIKER), "b": at(1.0, 0.0)}) == "b"
    assert STAYS > 0.0


def test_a_pass_is_left_to_its_receiver_and_not_to_its_kicker(pick):
    rolling = (0.6, 0.0, 4.0, 0.0)
    candidates = {"kicker": at(0.0, 0.0, Role.STRIKER), "receiver": at(5.0, 0.5, is_receiver=True)}
    assert pick(candidates, rolling) == "receiver"


def test_places_are_shared_so_that_the_sum_of_ways_is_least():
    wanted = [(Role.DEFENDER, (-5.0, 0.0)), (Role.LEFT, (2.0, 3.0)), (Role.RIGHT, (2.0, -3.0))]
    robots = {"a": at(2.0, -2.0), "b": at(-4.0, 0.0), "c": at(1.0, 3.0)}
    assert share_places(robots, wanted) == {"a": Role.RIGHT, "b": Role.DEFENDER, "c": Role.LEFT}


def test_a_small_team_fills_the_first_places():
    wanted = [(Role.DEFENDER, (-5.0, 0.0)), (Role.LEFT, (2.0, 3.0)), (Role.RIGHT, (2.0, -3.0))]
    assert share_places({"a": at(2.0, -2.0)}, wanted) == {"a": Role.DEFENDER}
    assert share_places({}, wanted) == {}


def test_the_farthest_robot_has_no_place_where_there_are_more_robots_than_places():
    """Five robots of a scene without a goalkeeper: one plays the ball, four are left for three places."""
    wanted = [(Role.DEFENDER, (-5.0, 0.0)), (Role.LEFT, (2.0, 3.0)), (Role.RIGHT, (2.0, -3.0))]
    robots = {"a": at(2.0, -2.0), "b": at(-4.0, 0.0), "c": at(1.0, 3.0), "d": at(-9.0, -5.0)}
    assert share_places(robots, wanted) == {"a": Role.RIGHT, "b": Role.DEFENDER, "c": Role.LEFT}


@pytest.mark.parametrize("ball", [(0.0, 0.0), (10.0, 6.5), (-10.5, 0.5), (-3.0, -6.0)])
def test_the_formation_leaves_the_ball_and_the_penalty_areas_alone(setup, ball):
    pitch = setup.pitch
    for _, (x, y) in places(ball, pitch, setup.robot.radius, 3):
        assert (x - ball[0]) ** 2 + (y - ball[1]) ** 2 >= 2.4**2 - 1e-9
        assert abs(x) < pitch.goal_line
        assert abs(y) < pitch.touch_line
