"""The ball in the own third: a pass that surely leaves it, or a kick away."""

import math

import pytest

from robot_agent.sdk.bodies import Body
from robot_agent.teams.reference.attacker import Situation, play_ball
from robot_agent.teams.reference.clearing import best_clear
from robot_agent.teams.reference.parameters import PARAMETERS
from robot_agent.teams.reference.passing import passes
from robot_agent.teams.reference.set_pieces import Restart, restart_kick
from schemas.messages.command import KickMode
from schemas.soccer.game import TeamPhase

BALL = (-8.0, 0.0)
NEAR = {"cyan3": Body(-6.0, 2.5, 0.0)}
"""A teammate in the own third."""
MARKER = (-5.5, 3.5)
"""An opponent in no pass's way."""
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


@pytest.mark.parametrize(("mates", "receiver"), [(NEAR, None), (FAR, "cyan3")])
def test_a_robot_whose_teammates_are_all_near_its_goal_kicks_the_ball_away(setup, limits, mates, receiver):
    toward_far = math.atan2(1.0, 7.0)
    me = Body(BALL[0] - setup.dribble.gap, -0.05, toward_far)
    now = Situation(me, mates, [MARKER], 0.5, None, may_score=False, must_pass=False)
    action = play_ball(now, setup, limits, PARAMETERS).action
    assert action.kick is not None
    assert action.pass_to == receiver
    assert (action.kick.speed == setup.kicker.max_ground_speed) is (receiver is None)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_ball_is_kicked_away_on_the_side_without_opponents(setup, side):
    clear = best_clear(BALL, 0.0, [(-6.8, side * 0.2), (-5.5, side * 2.0)], setup.pitch, PARAMETERS)
    assert clear.target[1] * side < 0.0
    assert clear.mode is KickMode.GROUND


def test_a_ball_whose_ways_along_the_ground_are_closed_is_lofted(setup):
    ring = [(BALL[0] + 3.0 * math.cos(angle / 5), BALL[1] + 3.0 * math.sin(angle / 5)) for angle in range(-7, 8)]
    assert best_clear(BALL, 0.0, ring, setup.pitch, PARAMETERS).mode is KickMode.LOFT


def test_a_robot_under_pressure_kicks_where_it_points_and_never_toward_its_own_goal(setup):
    close = [(BALL[0] + 0.5, BALL[1] - 0.4)]
    assert best_clear(BALL, 0.9, close, setup.pitch, PARAMETERS).target[1] > 5.0
    for heading in (math.pi, 2.0, -2.0):
        assert best_clear(BALL, heading, close, setup.pitch, PARAMETERS).target[0] > -2.0


def test_a_throw_in_is_kicked_into_the_pitch_rather_than_along_its_touch_line(setup):
    y = setup.pitch.touch_line
    assert best_clear((-8.0, y), 0.0, [], setup.pitch, PARAMETERS).target[1] < y - 2.0
    assert best_clear((-8.0, -y), 0.0, [], setup.pitch, PARAMETERS).target[1] > 2.0 - y


def test_a_restart_before_the_own_goal_is_kicked_away_where_no_pass_leads_out(setup):
    now = Restart(TeamPhase.OUR_GOAL_KICK, BALL, NEAR, [MARKER], running=True, waited=0.0, away=1.0, chosen=None)
    kick = restart_kick(now, setup, PARAMETERS)
    assert not kick.waits
    assert kick.target[0] > 0.0
    passed = restart_kick(now._replace(mates=FAR), setup, PARAMETERS)
    assert passed.aimed is not None
    assert passed.aimed.receiver == "cyan3"
    assert not passed.waits
