"""Where a robot without the ball stands, and what makes it go elsewhere."""

import pytest

from robot_agent.sdk.bodies import Ball, Body
from robot_agent.sdk.world_model import SeenBall, Teammate, WorldBelief
from robot_agent.teams.reference.give_and_go import Run
from robot_agent.teams.reference.held_place import HeldPlace
from robot_agent.teams.reference.parameters import PARAMETERS
from robot_agent.teams.reference.roles import Role
from schemas.messages.soccer.game import GameView
from schemas.soccer.game import TeamPhase

TAKEN, OTHER = (4.0, 2.0), (-1.0, -4.0)
"""m; the place that is held, and another that the formation has later."""
BALL = (0.0, 0.0)


def belief(opponents=(), mate=(0.0, 0.0), phase=TeamPhase.PLAY):
    game = GameView(phase=phase, running=phase is TeamPhase.PLAY, clock=0.0, our_score=0, their_score=0)
    mates = {"cyan3": Teammate(Body(*mate, 0.0), "", "", None)}
    return WorldBelief(1, 0.02, Body(0.0, 4.0, 0.0), False, SeenBall(Ball(*BALL), 0.0), mates, list(opponents), game)


@pytest.fixture
def held():
    """A supporter's place, taken with the ball in the middle."""
    place = HeldPlace(PARAMETERS)
    place.choose(belief(), Role.SUPPORTER, TAKEN, BALL, holds=True, passed=False)
    return place


def after(held, seen, *, spot=BALL, holds=True, role=Role.SUPPORTER):
    return held.choose(seen, role, OTHER, spot, holds=holds, passed=False)


def test_a_supporter_stays_where_it_can_be_passed_to(held):
    assert after(held, belief()) == TAKEN


def test_it_goes_where_the_lane_is_open_once_it_is_closed(held):
    assert after(held, belief(opponents=[(2.0, 1.0)])) == OTHER


def test_it_does_not_follow_a_ball_that_no_teammate_could_pass(held):
    assert after(held, belief(opponents=[(2.0, 1.0)]), holds=False) == TAKEN


@pytest.mark.parametrize("spot", [(-6.0, 0.0), (3.5, 2.0)])
def test_it_follows_a_ball_that_is_far_away_and_makes_room_for_one_that_comes(held, spot):
    assert after(held, belief(), spot=spot, holds=False) == OTHER


def test_it_makes_room_for_a_teammate(held):
    assert after(held, belief(mate=(4.5, 2.5))) == OTHER


@pytest.mark.parametrize("phase", [TeamPhase.PLAY, TeamPhase.OUR_THROW_IN, TeamPhase.THEIR_THROW_IN])
def test_two_robots_that_changed_roles_do_not_hold_the_same_place(held, phase):
    assert after(held, belief(mate=(4.3, 2.0), phase=phase)) == OTHER


def test_a_place_is_kept_while_a_teammate_passes_it_farther_away_than_the_robot():
    place, me = HeldPlace(PARAMETERS), (0.0, 4.0)
    seen = belief(mate=(0.5, 4.6), phase=TeamPhase.THEIR_THROW_IN)
    assert place.choose(seen, Role.SUPPORTER, me, BALL, holds=False, passed=False) == me
    assert after(place, seen, holds=False) == me


def test_a_marker_follows_its_opponent(held):
    assert after(held, belief(), role=Role.MARKER) == OTHER


@pytest.mark.parametrize("phase", [TeamPhase.OUR_THROW_IN, TeamPhase.THEIR_THROW_IN])
def test_a_place_of_a_restart_stays_until_the_next_restart(held, phase):
    assert after(held, belief(phase=phase)) == TAKEN
    assert after(held, belief(phase=phase), spot=(1.0, 7.0)) == OTHER


def test_a_place_that_was_taken_in_another_role_does_not_stay():
    place, seen = HeldPlace(PARAMETERS), belief(phase=TeamPhase.THEIR_KICK_OFF)
    assert place.choose(seen, Role.ATTACKER, TAKEN, BALL, holds=False, passed=False) == TAKEN
    assert place.choose(seen, Role.SUPPORTER, OTHER, BALL, holds=False, passed=False) == OTHER


def test_at_a_restart_of_our_own_a_covered_robot_goes_where_it_is_free(held):
    assert after(held, belief(opponents=[(2.0, 1.0)], phase=TeamPhase.OUR_THROW_IN)) == OTHER


def test_a_robot_that_has_passed_runs_while_the_team_has_the_ball(held):
    held.run = Run((6.0, 0.0), 2.0)
    assert after(held, belief()) == (6.0, 0.0)
    assert held.run is not None
    after(held, belief(), holds=False)
    assert held.run is None
