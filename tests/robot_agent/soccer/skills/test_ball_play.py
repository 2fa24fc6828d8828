"""Skills that have to do with the ball, alone or on an ideal drive."""

import math

import pytest

from robot_agent.sdk.bodies import Ball, Body
from robot_agent.soccer.skills.dribble_to import SPEED, TURN_RATE, dribble_to
from robot_agent.soccer.skills.intercept import meet, meeting_time, way_of
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.soccer.skills.kick_on_the_run import kick_on_the_run
from robot_agent.soccer.skills.line_up import behind, line_up
from robot_agent.soccer.skills.pass_to import ARRIVING, best_receiver, pass_speed
from robot_agent.soccer.skills.receive import receive
from robot_agent.soccer.skills.shoot import best_place, lane_width
from robot_agent.soccer.skills.take_ball import front_of_holder, take_ball
from schemas.config.rolling import Rolling
from schemas.config.soccer.kicked import Kicked

GAP = 0.35
GROUND = Rolling(0.5)


def test_a_ball_at_rest_is_met_where_it_lies(limits):
    meeting = meet(Body(0.0, 0.0, 0.0), way_of(Ball(2.0 + GAP, 0.0), GROUND), GAP, limits)
    assert meeting[:2] == pytest.approx((2.0 + GAP, 0.0))
    assert meeting.time == pytest.approx(math.sqrt(2.0 * 2.0 / limits.acceleration), abs=0.15)


def test_a_ball_that_rolls_by_is_met_ahead_of_where_it_is(limits):
    ball = Ball(3.0, -2.0, 0.0, 2.0)
    meeting = meet(Body(0.0, 0.0, 0.0), way_of(ball, GROUND), GAP, limits)
    there = ball.after(meeting.time, GROUND)
    assert (meeting.x, meeting.y) == pytest.approx((there.x, there.y), abs=0.05)
    assert -1.5 < meeting.y < 2.0


def test_a_ball_is_met_later_by_a_robot_that_has_to_be_there_ahead_of_it(limits):
    me, way = Body(0.0, 0.0, 0.0), way_of(Ball(3.0, -2.0, 0.0, 2.0), GROUND)
    at_once, ahead = meet(me, way, GAP, limits), meet(me, way, GAP, limits, ahead=0.3)
    assert ahead.time > at_once.time + 0.1
    assert ahead.y > at_once.y
    rests = way_of(Ball(2.0, 0.0), GROUND)
    assert meet(me, rests, GAP, limits, ahead=0.3)[:2] == meet(me, rests, GAP, limits)[:2]


def test_a_ball_out_of_reach_on_its_path_is_met_where_it_stops(limits):
    ball = Ball(4.0, 0.0, 9.0, 0.0)
    meeting = meet(Body(-9.0, 0.0, 0.0), way_of(ball, GROUND), GAP, limits)
    assert meeting.x == pytest.approx(way_of(ball, GROUND)[-1].x)


@pytest.mark.parametrize("start", [(-2.0, 0.5, 2.0), (1.0, 2.0, 0.0), (3.0, -1.0, -1.0)])
def test_a_robot_comes_to_hold_a_ball_at_rest(plant, limits, setup, start):
    robot, ball = plant(*start), Ball(0.0, 0.0)
    for _ in range(250):
        me = robot.body
        away, bearing = math.hypot(me.x, me.y), math.atan2(-me.y, -me.x) - me.heading
        if away <= setup.dribble.distance and abs(math.remainder(bearing, math.tau)) <= setup.dribble.cone / 2:
            break
        robot.step(take_ball(me, ball, meet(me, way_of(ball, GROUND), GAP, limits), GAP, [], 0.55, limits))
    else:
        pytest.fail(f"never held; ended at {me}")
    assert away > setup.robot.radius + setup.ball.radius - 0.02  # it did not run the ball over


def test_the_way_to_the_ball_leads_round_a_teammate_that_stands_in_it(plant, limits):
    """As seen in a match: a robot that chased the ball pushed a teammate before it for a second."""
    robot, ball, mate = plant(-3.0, 0.05, 0.0), Ball(1.5, 0.0), (-0.5, 0.0)
    nearest = math.inf
    for _ in range(250):
        me = robot.body
        nearest = min(nearest, math.dist(me[:2], mate))
        robot.step(take_ball(me, ball, meet(me, way_of(ball, GROUND), GAP, limits), GAP, [], 0.55, limits, [mate]))
    assert nearest > 0.5
    assert math.dist(robot.body[:2], ball[:2]) < 2.0 * GAP


def test_the_ball_of_an_opponent_is_taken_from_its_front():
    opponent, ball = (0.0, 0.0), Ball(0.35, 0.0)
    place = front_of_holder(Body(-1.0, 0.2, 0.0), ball, [opponent], GAP)
    assert place == pytest.approx((0.35 + GAP, 0.0))
    assert front_of_holder(Body(1.2, 0.1, math.pi), ball, [opponent], GAP) is None
    assert front_of_holder(Body(-1.0, 0.2, 0.0), Ball(1.0, 0.0), [opponent], GAP) is None


def test_behind_the_ball_faces_ball_and_target():
    x, y, heading = behind((1.0, 1.0), (1.0, 5.0), 0.6)
    assert (x, y, heading) == pytest.approx((1.0, 0.4, math.pi / 2))


def test_lining_up_from_the_wrong_side_never_touches_the_ball(plant, limits, setup):
    robot, ball = plant(1.5, 0.05, math.pi), (0.0, 0.0)
    touching = setup.robot.radius + setup.ball.radius
    nearest = math.inf
    for _ in range(300):
        me = robot.step(line_up(robot.body, ball, (5.0, 0.0), 0.6, [], limits))
        nearest = min(nearest, math.hypot(me.x, me.y))
    assert nearest > touching
    assert (me.x, me.y, me.heading) == pytest.approx((-0.6, 0.0, 0.0), abs=0.06)


def test_with_the_ball_a_robot_goes_gently(limits):
    demand = dribble_to(Body(0.0, 0.0, 0.0), 9.0, 0.0, 2.0, [], limits)
    assert math.hypot(demand.vx, demand.vy) <= SPEED + 1e-9
    assert abs(demand.omega) <= TURN_RATE + 1e-9


def test_a_kick_waits_until_the_axis_points_at_the_target(plant, limits):
    robot = plant(0.0, 0.0, 2.0)
    for _ in range(150):
        motion, kick = kick_at(robot.body, (6.0, 1.0), 8.0, 0.15, limits)
        if kick is not None:
            break
        robot.step(motion)
    passes = math.tan(robot.body.heading + robot.body.omega * limits.tick) * 6.0
    assert passes == pytest.approx(1.0, abs=0.17)
    assert kick.speed == 8.0


def test_a_kick_is_aimed_with_the_heading_of_the_next_tick(limits):
    """The command acts one tick after the sight that it answers."""
    turning, still = Body(0.0, 0.0, -0.05, omega=0.05 / limits.tick), Body(0.0, 0.0, -0.05)
    assert kick_at(turning, (6.0, 0.0), 8.0, 0.15, limits)[1] is not None
    assert kick_at(still, (6.0, 0.0), 8.0, 0.15, limits)[1] is None
    assert kick_at(turning._replace(heading=0.0), (6.0, 0.0), 8.0, 0.15, limits)[1] is None


def test_a_pass_arrives_with_the_speed_it_is_meant_to(setup):
    kicked, speed, time = Kicked.of(setup.ball, setup.kicker), pass_speed(5.0, setup), 0.0
    while kicked.after(speed, time)[1] < 5.0:
        time += 0.001
    assert kicked.after(speed, time)[0] == pytest.approx(ARRIVING, abs=0.01)
    assert pass_speed(1000.0, setup) == setup.kicker.max_ground_speed


def test_a_pass_goes_to_the_one_farthest_ahead_whose_lane_is_free():
    mates = {"a": (4.0, 3.0), "b": (5.0, -3.0), "c": (0.5, 0.5)}
    assert best_receiver((0.0, 0.0), mates, []) == "b"
    assert best_receiver((0.0, 0.0), mates, [(2.5, -1.5)]) == "a"
    assert best_receiver((0.0, 0.0), mates, [(2.5, -1.5), (2.0, 1.5)]) is None


def test_the_chosen_receiver_stays_until_another_is_clearly_better_or_his_lane_closes():
    mates = {"a": (4.0, 3.0), "b": (4.3, -3.0)}
    assert best_receiver((0.0, 0.0), mates, []) == "b"
    assert best_receiver((0.0, 0.0), mates, [], chosen="a") == "a"
    assert best_receiver((0.0, 0.0), {"a": (4.0, 3.0), "b": (5.2, -3.0)}, [], chosen="a") == "b"
    nearly_closed = [(1.6 + 0.6 * 0.55, 1.2 - 0.8 * 0.55)]
    assert best_receiver((0.0, 0.0), {"a": (4.0, 3.0)}, nearly_closed) is None
    assert best_receiver((0.0, 0.0), {"a": (4.0, 3.0)}, nearly_closed, chosen="a") == "a"
    assert best_receiver((0.0, 0.0), mates, [(2.0, 1.5)], chosen="a") == "b"


def test_a_lane_is_as_wide_as_the_nearest_opponent_beside_it_allows():
    assert lane_width((0.0, 0.0), (5.0, 0.0), [(2.0, 1.0)], 0.0) == pytest.approx(1.0)
    assert lane_width((0.0, 0.0), (5.0, 0.0), [(2.0, 1.0)], 0.1) == pytest.approx(0.8)
    assert lane_width((0.0, 0.0), (5.0, 0.0), [(-1.0, 0.0), (6.0, 0.0)]) == math.inf


def test_a_shot_goes_past_the_keeper_not_at_him(setup):
    low, _ = best_place((6.0, 0.0), [(10.6, 0.5)], setup.pitch)
    high, _ = best_place((6.0, 0.0), [(10.6, -0.5)], setup.pitch)
    assert low < 0.0 < high
    assert max(abs(low), abs(high)) < setup.pitch.goal_width / 2 - setup.ball.radius


@pytest.mark.parametrize("ball", [Ball(0.0, 0.0), Ball(1.0, -2.0, 2.5, 1.0), Ball(-4.0, 3.0, 0.0, -6.0)])
@pytest.mark.parametrize("me", [Body(0.2, 0.1, 0.0), Body(-3.0, 1.0, 0.0, 1.5, 0.5), Body(9.0, -6.0, 1.0, 0.0, -2.0)])
def test_a_meeting_is_timed_exactly_unless_it_is_later_than_asked_for(limits, me, ball):
    way = way_of(ball, GROUND)
    exact = meet(me, way, GAP, limits).time
    assert meeting_time(me, way, GAP, limits, by=math.inf) == exact
    for by in (0.0, 0.3, 0.9, 2.0):
        told = meeting_time(me, way, GAP, limits, by)
        assert told == exact or by < told <= exact


def test_a_ball_at_rest_that_was_expected_is_faced(limits):
    demand = receive(Body(0.0, 0.0, 0.0), Ball(0.0, 2.0), limits)
    assert (demand.vx, demand.vy) == (0.0, 0.0)
    assert demand.omega > 0.0


def test_a_kick_on_the_run_keeps_the_speed_and_kicks_once_the_ball_passes_the_target(limits):
    demand, kick = kick_on_the_run(Body(0.0, 0.0, 0.0, 2.0, 0.0), (8.0, 0.1), 9.0, 0.2, (2.0, 0.0), limits)
    assert demand.vx == pytest.approx(2.0, abs=0.01)
    assert kick is not None and kick.speed == 9.0


def test_a_kick_on_the_run_slows_down_and_turns_while_the_target_is_beside_the_kick_axis(limits):
    demand, kick = kick_on_the_run(Body(0.0, 0.0, 0.0, 2.0, 0.0), (4.0, 4.0), 9.0, 0.2, (2.0, 0.0), limits)
    assert kick is None
    assert math.hypot(demand.vx, demand.vy) < 1.4 and demand.omega > 0.0
