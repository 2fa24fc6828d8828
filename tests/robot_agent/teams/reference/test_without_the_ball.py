"""Roles, places, and what teammates know of each other."""

import math
from itertools import combinations

import pytest

from robot_agent.sdk.bodies import Ball, Body
from robot_agent.teams.reference.estimate import SharedEstimate, report, reported
from robot_agent.teams.reference.formation import places
from robot_agent.teams.reference.keeper import fetches, guard, shot_crossing
from robot_agent.teams.reference.parameters import PARAMETERS
from robot_agent.teams.reference.recovery import BackOut
from robot_agent.teams.reference.roles import Candidate, Place, Role, attacker_of, share_places
from schemas.messages.sight import BallSight, Motion, ReceivedRadio

ROBOTS = ((-2.0, 1.0), (-2.0, -1.0), (-5.0, 0.0))


def at(pitch, ball, opponents=(), *, attacks):
    return places(
        ball, attacks=attacks, opponents=opponents, robots=ROBOTS, pitch=pitch, inset=0.25, parameters=PARAMETERS
    )


def test_reports_of_opponents_arrive_as_they_were_sent():
    words = report([(1.0, 2.0), (-3.25, 0.5)], (0.0, 0.0), 1.234)
    assert reported(words) == [(1.0, 2.0), (-3.25, 0.5)]
    assert words["arrival"] == 1.23
    assert len(report([(float(n), 0.0) for n in range(30)], (0.0, 0.0), 1.0)) <= 16


def test_the_first_at_the_ball_attacks_and_another_takes_over_only_when_clearly_earlier():
    here = Body(0.0, 0.0, 0.0)
    two = {"a": Candidate(here, 1.0, ""), "b": Candidate(here, 0.8, "")}
    assert attacker_of(two, PARAMETERS) == "b"
    assert attacker_of(two | {"a": Candidate(here, 1.0, Role.ATTACKER)}, PARAMETERS) == "a"
    assert attacker_of(two | {"a": Candidate(here, 2.0, Role.ATTACKER)}, PARAMETERS) == "b"


def test_the_receiver_of_a_pass_goes_for_it_even_if_another_is_nearer():
    here = Body(0.0, 0.0, 0.0)
    two = {"a": Candidate(here, 1.6, "", is_receiver=True), "b": Candidate(here, 0.8, "")}
    assert attacker_of(two, PARAMETERS) == "a"


def test_places_are_shared_with_the_least_total_way():
    candidates = {"a": Candidate(Body(0.0, 0.0, 0.0), 1.0, ""), "b": Candidate(Body(4.0, 0.0, 0.0), 1.0, "")}
    wanted = [Place(Role.GUARD, (3.0, 0.0)), Place(Role.SUPPORTER, (-1.0, 0.0))]
    shared = share_places(candidates, wanted, PARAMETERS)
    assert {name: place.role for name, place in shared.items()} == {"a": Role.SUPPORTER, "b": Role.GUARD}


def test_in_attack_supporters_are_apart_and_outside_the_penalty_areas(setup):
    pitch = setup.pitch
    for ball in ((0.0, 0.0), (7.0, 3.0), (-8.0, -5.0), (9.5, 0.0)):
        found = at(pitch, ball, attacks=True)
        assert len(found) == len(ROBOTS)
        supporters = [place.at for place in found if place.role is Role.SUPPORTER]
        assert all(math.dist(one, other) > 2.0 for one, other in combinations(supporters, 2))
        assert all(abs(place.at[0]) < pitch.goal_line - pitch.penalty_area_depth for place in found)


def test_in_defence_one_blocks_and_a_free_opponent_is_marked_between_it_and_the_ball(setup):
    found = at(setup.pitch, (-5.0, 3.0), [(-4.6, 3.0), (-6.0, -2.0)], attacks=False)
    assert [place.role for place in found] == [Role.BLOCKER, Role.GUARD, Role.MARKER]
    marker = found[-1].at
    assert math.dist(marker, (-6.0, -2.0)) < 1.2
    assert math.dist(marker, (-5.0, 3.0)) < math.dist((-6.0, -2.0), (-5.0, 3.0))


@pytest.mark.parametrize("ball", [(-8.0, 0.2), (-8.1, -1.0), (-7.5, 3.0), (-9.5, 0.0), (-10.5, -5.0)])
def test_before_the_own_penalty_area_defenders_stand_apart_and_not_where_the_ball_is(setup, ball):
    found = at(setup.pitch, ball, [(ball[0] + 0.4, ball[1])], attacks=False)
    assert Role.GUARD in [place.role for place in found]
    assert all(math.dist(place.at, ball) > 1.2 for place in found)
    assert all(math.dist(one.at, other.at) > 1.2 for one, other in combinations(found, 2))


def test_the_keeper_stands_on_its_line_where_a_lob_passes_lowest(setup, limits, plant):
    pitch, reach = setup.pitch, setup.robot.reach
    robot = plant(-10.2, 0.0, 0.0)
    for _ in range(150):
        robot.step(guard(robot.body, Ball(-5.0, 3.0), [], pitch, reach, limits, PARAMETERS))
    assert abs(robot.body.x + pitch.goal_line) < 0.08
    assert 0.0 < robot.body.y < 0.5 * pitch.goal_width


def test_a_keeper_beside_its_goal_comes_back_before_the_post(setup, limits, plant):
    pitch, reach = setup.pitch, setup.robot.reach
    robot = plant(-10.8, 1.7, 1.57)
    between = 0.5 * pitch.goal_width - reach
    for _ in range(200):
        robot.step(guard(robot.body, Ball(-10.7, 6.7), [], pitch, reach, limits, PARAMETERS))
        beside_post = between < robot.body.y < 0.5 * pitch.goal_width + reach
        assert not beside_post or robot.body.x > -pitch.goal_line + setup.robot.radius
    assert robot.body.y < between
    assert abs(robot.body.x + pitch.goal_line) < 0.08


def test_the_keeper_crosses_the_way_of_a_shot(setup):
    pitch, reach = setup.pitch, setup.robot.reach
    assert shot_crossing(Ball(-5.0, 0.0, -6.0, 0.6), -11.0, pitch, reach, PARAMETERS) == 0.6
    assert shot_crossing(Ball(-5.0, 0.0, -6.0, 6.0), -11.0, pitch, reach, PARAMETERS) is None
    assert shot_crossing(Ball(-5.0, 0.0, 6.0, 0.0), -11.0, pitch, reach, PARAMETERS) is None


def test_the_keeper_comes_out_for_a_slow_ball_that_it_reaches_first(setup, limits, rolling):
    me, ball = Body(-11.0, 0.0, 0.0), Ball(-9.5, 0.5)
    assert fetches(me, ball, [(-5.0, 0.0)], rolling, setup.pitch, limits, PARAMETERS, has_area=True)
    assert not fetches(me, ball, [(-9.0, 0.5)], rolling, setup.pitch, limits, PARAMETERS, has_area=True)
    assert not fetches(me, Ball(-2.0, 0.0), [], rolling, setup.pitch, limits, PARAMETERS, has_area=True)


def test_the_keeper_comes_off_its_line_for_a_ball_that_is_too_near_for_a_lob_until_it_is_kicked(setup, limits):
    pitch, reach = setup.pitch, setup.robot.reach
    balls = Ball(-8.8, 0.0), Ball(-6.5, 0.0), Ball(-8.8, 0.0, -8.0, 2.0)
    near, far, kicked = (guard(Body(-11.0, 0.0, 0.0), ball, [], pitch, reach, limits, PARAMETERS) for ball in balls)
    assert abs(far.vx) < 0.1 < 0.5 < near.vx
    assert abs(kicked.vx) < 0.01 < kicked.vy


def test_the_keeper_moves_to_the_side_to_which_the_holder_of_the_ball_points(setup, limits):
    """Before it the ball is in the middle, so that only the line from the holder through the ball tells the side."""
    pitch, reach, me, ball = setup.pitch, setup.robot.reach, Body(-11.0, 0.0, 0.0), Ball(-6.5, 0.0)
    for side in (1.0, -1.0):
        holder = (-6.16, -0.06 * side)
        assert side * guard(me, ball, [holder], pitch, reach, limits, PARAMETERS).vy > 0.2
    beside = (-6.5, 0.4)
    assert abs(guard(me, ball, [beside], pitch, reach, limits, PARAMETERS).vy) < 0.05


def test_a_ball_that_lies_in_the_goal_area_is_the_keepers_although_opponents_press(setup, limits, rolling):
    me, opponents = Body(-11.0, 0.8, 0.0), [(-10.1, 1.5)]
    lies, rolls = Ball(-10.58, 1.55), Ball(-10.58, 1.55, 0.0, -1.2)
    assert fetches(me, lies, opponents, rolling, setup.pitch, limits, PARAMETERS, has_area=True)
    assert not fetches(me, rolls, opponents, rolling, setup.pitch, limits, PARAMETERS, has_area=True)
    assert not fetches(me, lies, opponents, rolling, setup.pitch, limits, PARAMETERS, has_area=False)


def test_a_stuck_robot_backs_out_for_a_moment(limits):
    back_out, me = BackOut(PARAMETERS), Body(0.0, 0.0, 0.0)
    assert back_out.motion(me, 0.1, [(0.5, 0.0)], 0.02, limits) is None
    away = back_out.motion(me, 1.0, [(0.5, 0.0)], 0.02, limits)
    assert away is not None
    assert away.vx < 0.0
    ticks = 0
    while back_out.motion(me, 0.0, [(0.5, 0.0)], 0.02, limits) is not None:
        ticks += 1
    assert 20 < ticks < 60


def test_a_ball_in_the_air_is_known_to_fly_and_one_that_rolls_is_not(briefing, sight_of):
    estimate = SharedEstimate(briefing, PARAMETERS)
    for tick, (height, flies) in enumerate(((1.2, True), (0.11, False))):
        estimate.update(sight_of(tick, ball=BallSight(x=3.0, y=0.0, z=height, vx=-4.0, vy=0.0)))
        assert estimate.is_flying is flies
    estimate.update(sight_of(2, ball=None))
    assert not estimate.is_flying


@pytest.mark.parametrize("number", [-1e9, 12.5, 1e9])
def test_what_a_teammate_sends_that_cannot_be_is_not_believed(briefing, sight_of, number):
    """A teammate of another author may send any number by any name."""
    estimate = SharedEstimate(briefing, PARAMETERS)
    words = {"x0": number, "y0": 0.0, "x1": 1.0, "y1": 2.0, "arrival": -3.0}
    said = ReceivedRadio(age=0.0, self=Motion(x=-5.0, y=-3.0, heading=0.0), extra=words)
    belief = estimate.update(sight_of(radio={"cyan3": said}))
    assert belief.opponents == [(1.0, 2.0)]
    assert estimate.words["cyan3"].arrival == math.inf
