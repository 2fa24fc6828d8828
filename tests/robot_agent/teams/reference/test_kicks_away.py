"""The ball in the own third: a pass that surely leaves it, or a kick away."""

import math

import pytest

from robot_agent.sdk.bodies import Body
from robot_agent.teams.reference.attacker import Situation, play_ball
from robot_agent.teams.reference.clearing import best_clear
from robot_agent.teams.reference.parameters import PARAMETERS
from robot_agent.teams.reference.passing import passes
from robot_agent.teams.reference.set_pieces import KICK_OFF_TO, Restart, restart_kick
from schemas.soccer.game import TeamPhase

BALL = (-8.0, 0.0)
NEAR = {"cyan3": Body(-6.0, 2.5, 0.0)}
"""A teammate in the own third."""
MARKER = (-6.5, -1.7)
"""An opponent that presses, in no pass's way."""
FAR = {"cyan3": Body(-1.0, 1.0, 0.0)}
"""A teammate outside it."""


def receivers(mates, opponents, setup):
    return {one.receiver for one in passes(BALL, 0.0, mates, opponents, None, setup.pitch, PARAMETERS)}


def test_a_pass_in_the_own_third_has_to_leave_it(setup):
    assert receivers(NEAR, [], setup) == set()
    assert receivers(FAR, [], setup) == {"cyan3"}


def test_a_pass_out_of_the_own_third_gets_through_its_first_metres_surely(setup):
    """The same opponent costs little at the receiver, and a goal near the kick."""
    assert receivers(FAR, [(-6.0, 1.2)], setup) == set()
    assert receivers(FAR, [(0.5, -1.2)], setup) == {"cyan3"}


def play(mates, opponents, setup, limits):
    me = Body(BALL[0] - setup.dribble.gap, -0.05, math.atan2(1.0, 7.0))
    now = Situation(me, mates, opponents, 0.5, None, may_score=False, must_pass=False)
    return play_ball(now, setup, limits, PARAMETERS).action


@pytest.mark.parametrize(("mates", "receiver"), [(NEAR, None), (FAR, "cyan3")])
def test_a_pressed_robot_whose_teammates_are_all_near_its_goal_kicks_the_ball_away(setup, limits, mates, receiver):
    action = play(mates, [MARKER], setup, limits)
    assert action.kick is not None
    assert action.pass_to == receiver
    assert (action.kick.speed == setup.kicker.max_ground_speed) is (receiver is None)


def test_a_robot_with_room_carries_the_ball_out_of_the_own_third(setup, limits):
    action = play(NEAR, [(-4.5, -1.7)], setup, limits)
    assert action.kick is None
    assert action.drive.vx > 1.0


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_ball_is_kicked_away_on_the_side_without_opponents(setup, side):
    clear = best_clear(BALL, 0.0, [(-6.8, side * 0.2), (-5.5, side * 2.0)], setup.pitch, PARAMETERS)
    assert clear.target[1] * side < 0.0


def test_a_robot_under_pressure_kicks_where_it_points_and_never_toward_its_own_goal(setup):
    close = [(BALL[0] + 0.5, BALL[1] - 0.4)]
    assert best_clear(BALL, 0.9, close, setup.pitch, PARAMETERS).target[1] > 5.0
    for heading in (math.pi, 2.0, -2.0):
        assert best_clear(BALL, heading, close, setup.pitch, PARAMETERS).target[0] > -2.0


def test_a_throw_in_is_kicked_into_the_pitch_rather_than_along_its_touch_line(setup):
    y = setup.pitch.touch_line
    assert best_clear((-8.0, y), 0.0, [], setup.pitch, PARAMETERS).target[1] < y - 2.0
    assert best_clear((-8.0, -y), 0.0, [], setup.pitch, PARAMETERS).target[1] > 2.0 - y


def test_a_restart_before_the_own_goal_is_kicked_away_if_no_pass_leads_out_in_time(setup):
    now = Restart(TeamPhase.OUR_GOAL_KICK, BALL, NEAR, [MARKER], running=True, waited=0.5, away=1.0, chosen=None)
    assert restart_kick(now, setup, PARAMETERS).waits
    late = restart_kick(now._replace(waited=3.0), setup, PARAMETERS)
    assert late.target[0] > 0.0
    assert late.speed == setup.kicker.max_ground_speed
    passed = restart_kick(now._replace(mates=FAR), setup, PARAMETERS)
    assert passed.aimed is not None
    assert passed.aimed.receiver == "cyan3"
    assert not passed.waits


def test_a_kick_off_goes_back_to_a_free_teammate_after_a_line_up_in_the_own_half(setup):
    mates = {"cyan3": Body(-2.9, -1.5, 0.0)}
    now = Restart(
        TeamPhase.OUR_KICK_OFF, (0.0, 0.0), mates, [(3.1, 1.6)], running=False, waited=0.0, away=0.6, chosen=None
    )
    assert restart_kick(now, setup, PARAMETERS).target == KICK_OFF_TO
    kick = restart_kick(now._replace(running=True), setup, PARAMETERS)
    assert kick.aimed is not None
    assert kick.aimed.receiver == "cyan3"
    assert not kick.waits
