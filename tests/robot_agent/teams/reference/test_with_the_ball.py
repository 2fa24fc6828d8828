"""What the robot with the ball does."""

import math

import pytest

from robot_agent.sdk.bodies import Body
from robot_agent.teams.reference.attacker import Situation, play_ball
from robot_agent.teams.reference.give_and_go import Run, run_after, run_past
from robot_agent.teams.reference.parameters import PARAMETERS
from robot_agent.teams.reference.passing import chance, in_time, passes
from robot_agent.teams.reference.shooting import best_shot, shot_ahead
from schemas.messages.command import KickMode

PRESSED = {
    "cyan1": (-10.5, 0, 0),
    "cyan2": (-2.0, 0.0, 0),
    "cyan3": (1.5, 3.0, math.pi),
    "magenta1": (10.5, 0, math.pi),
    "magenta2": (-0.3, -0.3, math.pi),
}
"""An opponent comes at cyan2, which has the ball; cyan3 is free."""


def test_a_robot_before_an_open_goal_scores(scene):
    robots = {"cyan1": (-10.5, 0, 0), "cyan2": (5.5, 0.5, 0), "magenta1": (-5, 6, 0), "magenta2": (-6, 5, 0)}
    played = scene(robots, (6.0, 0.5)).play(4.0, lambda played: played.goals > 0)
    assert played.goals == 1


def test_a_shot_goes_beside_the_keeper(setup):
    shot = best_shot((6.0, 0.0), 0.0, [(10.6, 0.5)], setup.pitch, PARAMETERS)
    assert shot is not None
    assert shot.target[1] < 0.0


def test_a_shot_from_near_is_surer_than_one_from_which_the_keeper_has_time_to_move(setup):
    near, far = (best_shot((x, 0.0), 0.0, [(10.8, 0.0)], setup.pitch, PARAMETERS) for x in (7.2, 5.0))
    assert near is not None
    assert far is not None
    assert near.chance > 0.9
    assert far.chance < 0.2


def test_a_shot_where_the_robot_points_is_taken_before_its_turn_to_the_best_one_has_ended(setup, limits):
    now = Situation(Body(7.2, 0.3, -0.27), {}, [(10.9, 0.3)], 1.0, None, may_score=True, must_pass=False)
    choice = play_ball(now, setup, limits, PARAMETERS)
    assert choice.action.kick is not None
    assert choice.shot is not None
    assert choice.shot.target[1] < -0.9  # where it would have turned to


def test_a_kick_that_would_pass_the_goal_or_a_post_is_no_shot(setup):
    for heading in (0.4, -0.4, 2.0):
        assert shot_ahead((8.0, 0.0), heading, [], setup.pitch, PARAMETERS) is None


def test_a_shot_where_the_robot_points_reckons_with_a_keeper_that_is_not_seen(setup):
    far, near = (shot_ahead((x, 0.0), 0.0, [], setup.pitch, PARAMETERS) for x in (6.0, 8.5))
    assert far is not None
    assert near is not None
    assert far.chance < 0.1
    assert near.chance > 0.9


def test_a_robot_that_aims_keeps_its_corner_while_the_keeper_is_before_the_middle(setup):
    """The noise of the keeper's place would choose another corner in each tick."""
    first = best_shot((7.0, 0.0), 0.0, [(10.9, 0.02)], setup.pitch, PARAMETERS)
    then = best_shot((7.0, 0.0), 0.0, [(10.9, -0.02)], setup.pitch, PARAMETERS, first)
    assert first is not None
    assert then is not None
    assert then.target == first.target


def test_of_two_open_corners_the_one_that_the_robot_faces_is_chosen(setup):
    for heading in (0.25, -0.25):
        shot = best_shot((6.8, 0.0), heading, [(10.8, 0.0)], setup.pitch, PARAMETERS)
        assert shot is not None
        assert shot.target[1] * heading > 0.0


def test_alone_before_a_keeper_it_scores_in_at_least_five_of_six(play):
    runs = play.over("one_against_keeper", seeds=range(1, 7), cyan2="robot_agent.teams.reference:Reference")
    runs.at_least(5, lambda facts: facts.has("goal:cyan"))


def test_a_wall_on_the_ground_is_lobbed_over(setup):
    wall = [(9.0, y) for y in (-1.0, -0.5, 0.0, 0.5, 1.0)]
    shot = best_shot((5.0, 0.0), 0.0, wall, setup.pitch, PARAMETERS)
    assert shot is not None
    assert shot.mode is KickMode.LOB


def test_a_robot_that_has_to_give_up_the_ball_keeps_aiming_at_the_goal(setup, limits):
    """An opponent is beside it; the chance of the shot is between the thresholds of late and of aiming robots."""
    late = Situation(Body(4.65, 0.0, 0.0), {}, [(4.4, 0.9), (10.8, 0.0)], 3.5, None, may_score=True, must_pass=True)
    first = play_ball(late, setup, limits, PARAMETERS)
    assert PARAMETERS.shot_late < first.weighed["shot"] < PARAMETERS.shot_keeps
    assert first.shot is not None
    assert play_ball(late._replace(aimed=first.shot), setup, limits, PARAMETERS).shot is not None


def test_there_is_no_shot_from_the_own_half(setup):
    assert best_shot((-1.0, 0.0), 0.0, [], setup.pitch, PARAMETERS) is None


def test_an_opponent_in_the_lane_makes_a_pass_fail_and_one_beside_it_does_not():
    assert chance((0.0, 0.0), (5.0, 0.0), [(2.5, 0.1)], PARAMETERS) == 0.0
    assert chance((0.0, 0.0), (5.0, 0.0), [(2.5, 3.0)], PARAMETERS) == 1.0
    assert chance((0.0, 0.0), (5.0, 0.0), [(-3.0, 0.0)], PARAMETERS) == 1.0


def test_the_best_pass_goes_to_the_free_teammate_and_not_into_an_opponent(setup):
    mates = {"cyan3": Body(4.0, 2.0, 0.0), "cyan4": Body(4.0, -2.0, 0.0)}
    found = passes((0.0, 0.0), 0.0, mates, [(2.5, 1.2), (4.0, 2.8)], None, setup.pitch, PARAMETERS)
    assert max(found, key=lambda one: one.value).receiver == "cyan4"


def test_a_chosen_pass_stays_while_another_is_as_good(setup):
    mates = {"cyan3": Body(4.0, 2.0, 0.0), "cyan4": Body(4.0, -2.0, 0.0)}
    for name, mate in mates.items():
        found = passes((0.0, 0.0), 0.0, mates, [], (name, mate[:2]), setup.pitch, PARAMETERS)
        assert max(found, key=lambda one: one.value).receiver == name


def test_a_pressed_robot_passes_to_a_free_mate_which_comes_to_meet_the_ball(scene):
    played = scene(PRESSED, (-1.6, 0.0)).play(
        6.0, lambda played: bool(played.commands) and played.match.simulation.now.world["possession"] == "cyan3"
    )
    assert [command.radio.pass_to for command in played.kicks("cyan2")] == ["cyan3"]
    assert played.match.simulation.now.world["possession"] == "cyan3"


def test_a_robot_that_has_passed_runs_past_its_opponent_and_often_has_the_ball_returned_there(scene):
    returned = 0
    for seed in range(1, 9):
        played = scene(PRESSED, (-1.6, 0.0), seed=seed).play(3.0, lambda played: bool(played.kicks("cyan3")))
        assert played.kicks("cyan2")[0].radio.pass_to == "cyan3"
        played.play(3.0, lambda played: played.match.simulation.now.world["possession"] == "cyan2")
        world = played.match.simulation.now.world
        beyond = world["robots"]["cyan2"]["x"] > world["robots"]["magenta2"]["x"] + 1.0
        returned += beyond and world["possession"] == "cyan2"
    assert returned >= 4


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_run_passes_the_opponent_on_the_side_of_the_free_way_back(setup, side):
    opponents = [(1.5, 0.0), (2.5, side * 1.5)]
    run = run_past(Body(0.0, 0.0, 0.0), (3.0, 0.0), opponents, setup.pitch, 8.0, PARAMETERS)
    assert run is not None
    assert run.to[0] > 3.0
    assert run.to[1] * side < 0.0


def test_there_is_no_run_without_an_opponent_ahead_or_into_the_penalty_area(setup):
    me = Body(0.0, 0.0, 0.0)
    assert run_past(me, (3.0, 2.0), [(-1.0, 0.0), (2.0, 3.0)], setup.pitch, 8.0, PARAMETERS) is None
    assert run_past(Body(6.5, 0.0, 0.0), (7.0, 3.0), [(7.5, 0.0)], setup.pitch, 8.0, PARAMETERS) is None


def test_a_run_ends_where_it_leads_with_its_time_and_with_the_ball():
    run, me = Run((3.0, 1.0), 0.1), Body(0.0, 0.0, 0.0)
    assert run_after(run, me, 0.02, ours=True) == Run((3.0, 1.0), pytest.approx(0.08))
    assert run_after(run, me, 0.02, ours=False) is None
    assert run_after(run, me, 0.2, ours=True) is None
    assert run_after(run, Body(2.9, 1.0, 0.0), 0.02, ours=True) is None


def test_a_through_ball_past_a_defender_is_received_ahead_of_where_the_receiver_was(play):
    def is_through(facts):
        for one in facts.passes:
            kicked, received = (int((facts.times < time).sum()) for time in (one.time, one.ended))
            if one.outcome == "received" and facts.ball[received][0] > facts.robots[one.by][kicked][0] + 0.5:
                return True
        return False

    play.over("two_on_one", seeds=range(1, 9), cyan="robot_agent.teams.reference:Reference").at_least(3, is_through)


def test_a_pass_for_which_the_robot_has_to_turn_before_an_opponent_comes_is_worth_less():
    free, pressed = ([(2.6, 0.0)], [(0.6, 0.0)])
    assert in_time(0.2, (0.0, 0.0), free, PARAMETERS) == in_time(0.0, (0.0, 0.0), pressed, PARAMETERS) == 1.0
    assert in_time(3.0, (0.0, 0.0), pressed, PARAMETERS) < 0.2 < in_time(1.0, (0.0, 0.0), pressed, PARAMETERS)


def test_a_keeper_that_is_seen_behind_its_line_still_keeps(setup):
    before, behind = (best_shot((4.5, -2.4), 0.3, [(x, -0.1)], setup.pitch, PARAMETERS) for x in (10.8, 11.4))
    assert before is not None
    assert behind is not None
    assert before.chance < 0.2
    assert behind.chance < 0.2
