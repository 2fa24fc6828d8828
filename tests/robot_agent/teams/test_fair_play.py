"""What a robot knows of its own catches, ways and side's possession, against what the rules in play ask."""

import math

import pytest

from robot_agent.sdk.bodies import Ball, Body
from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.skills.keep_out import Area
from robot_agent.sdk.world_model import SeenBall, Teammate, WorldBelief
from robot_agent.teams.area_turn import AreaTurn
from robot_agent.teams.fair_play import HALFWAY, PAUSE, Possession, RuleLimits, carry_after, possession_after
from robot_agent.teams.simple import Simple
from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.setup import Setup
from schemas.messages.sight import Motion, ReceivedRadio
from schemas.messages.soccer.game import GameView
from schemas.soccer.game import TeamPhase

AT, NOBODYS = Body(-3.0, 0.0, 0.0), Possession()
RELEASED = 0.455
"""m."""
PASS = 1.0
"""m of free roll."""


@pytest.fixture(scope="session")
def league():
    return Setup.of(MatchConfig(), load_profile("msl"), load_rule_book("msl"))


def scene(ball=(0.0, 0.0), me=AT, holding=False, mates=(), opponents=(), phase=TeamPhase.PLAY):
    game = GameView(phase=phase, running=True, clock=0.0, our_score=0, their_score=0)
    found = {f"cyan{number}": Teammate(Body(x, y, 0.0), "", "", None) for number, x, y in mates}
    return WorldBelief(1, 0.02, me, holding, SeenBall(Ball(*ball), 0.0), found, list(opponents), game)


def after(*scenes, before=NOBODYS):
    for one in scenes:
        before = possession_after(before, one, "cyan2", PASS)
    return before


def test_a_friendly_asks_only_to_keep_out_of_areas_and_to_spare_opponents(setup, league):
    assert RuleLimits.of(setup) == RuleLimits(
        math.inf, math.inf, True, 1, False, math.inf, False, 1.0, True, pytest.approx(RELEASED)
    )
    assert RuleLimits.of(league) == RuleLimits(3.0, 1.0, True, 1, True, 10.0, True, 1.0, True, pytest.approx(RELEASED))


def test_where_a_crowded_penalty_area_is_a_foul_at_once_robots_know():
    simulation_league = Setup.of(MatchConfig(), load_profile("msl"), load_rule_book("china-sim-2020"))
    assert RuleLimits.of(simulation_league).at_once


def test_a_carry_knows_its_way_from_the_catch_and_the_way_backward():
    carry = carry_after(None, scene((0.0, 0.0), holding=True), RELEASED)
    back = Body(0.0, 0.0, 0.0, vx=-1.0)
    for x in (-0.5, -1.0):
        carry = carry_after(carry, scene((x, 0.0), me=back, holding=True), RELEASED)
    assert carry.caught == (0.0, 0.0) and carry.way == 1.0 and carry.backward == pytest.approx(0.04)
    assert carry_after(carry, scene((0.0, 0.0)), RELEASED) is None


def test_a_hold_that_is_interrupted_for_a_moment_is_the_same_dribble_until_the_ball_is_released():
    carry = carry_after(None, scene((0.3, 0.0), me=Body(0.0, 0.0, 0.0), holding=True), RELEASED)
    for x in (1.0, 2.0):
        carry = carry_after(carry, scene((x + 0.4, 0.0), me=Body(x, 0.0, 0.0)), RELEASED)
        assert carry.caught == (0.3, 0.0)
    again = carry_after(carry, scene((2.6, 0.0), me=Body(2.2, 0.0, 0.0), holding=True), RELEASED)
    assert again.way == pytest.approx(2.3)
    assert carry_after(carry, scene((2.5, 0.0), me=Body(2.0, 0.0, 0.0)), RELEASED) is None
    for _ in range(round(PAUSE / 0.02) + 1):
        carry = carry_after(carry, scene((2.4, 0.0), me=Body(2.0, 0.0, 0.0)), RELEASED) if carry else None
    assert carry is None


@pytest.mark.parametrize(("x", "may_score"), [(HALFWAY + 0.1, True), (-1.0, False)])
def test_a_ball_won_in_the_other_half_may_be_shot_at_once(x, may_score):
    assert after(scene((x, 0.0), holding=True)).may_score is may_score


@pytest.mark.parametrize(("receives_at", "may_score"), [(2.0, True), (1.2, False), (-3.0, False)])
def test_a_ball_won_in_the_own_half_may_be_shot_after_a_pass_that_rolled_and_was_received_ahead(receives_at, may_score):
    won, kicked = scene((-1.0, 0.0), holding=True), scene((0.0, 0.0), holding=True)
    received = scene((receives_at, 0.0), mates=[(3, receives_at + 0.3, 0.0)])
    assert after(won, kicked, received).may_score is may_score


def test_an_opponent_at_the_ball_alone_has_it():
    assert after(scene((2.0, 0.0), holding=True), scene((2.0, 0.0), opponents=[(2.3, 0.0)])).ours is False


def test_in_a_duel_the_possession_does_not_change():
    duel = scene((2.0, 0.0), mates=[(3, 2.3, 0.0)], opponents=[(1.7, 0.0)])
    assert after(duel, before=Possession(False)).ours is False
    assert after(scene((2.0, 0.0), holding=True), duel).ours is True


@pytest.mark.parametrize(("phase", "ours"), [(TeamPhase.OUR_THROW_IN, True), (TeamPhase.THEIR_THROW_IN, False)])
def test_a_restart_belongs_to_its_taker(phase, ours):
    assert after(scene((2.0, 0.0), phase=phase)).ours is ours


def play(robot, sight_of, way, **seen):
    """Carry the ball so far at 1.5 m/s; the last command."""
    for tick in range(round(way / 0.03) + 1):
        x = -4.0 + 0.03 * tick
        at = (x, 0.0, 0.0)
        command = robot.act(sight_of(tick, at=at, velocity=(1.5, 0.0, 0.0), ball=(x + 0.35, 0.0), holding=True, **seen))
    return command


@pytest.mark.parametrize(("way", "lets_go"), [(1.6, False), (1.8, True)])
def test_1_3_m_before_the_circle_ends_the_ball_is_let_go(league, sight_of, way, lets_go):
    robot = Simple(Briefing.of("cyan2", league))
    command = play(robot, sight_of, way)
    assert (command.kick is not None) is lets_go
    if lets_go:
        assert 1.5 < command.kick.speed < 4.0


def test_a_robot_with_no_room_ahead_stops_inside_the_circle(league, sight_of):
    robot = Simple(Briefing.of("cyan2", league))
    command = play(robot, sight_of, 2.6, obstacles=((-0.3, 0.0),))
    assert command.kick is None and (command.drive.vx, command.drive.vy) == (0.0, 0.0)


def test_a_robot_with_no_room_ahead_brakes_toward_the_end_of_the_circle(league, sight_of):
    robot = Simple(Briefing.of("cyan2", league))
    speeds = [play(robot, sight_of, way, obstacles=((-0.3, 0.0),)).drive.vx for way in (1.0, 1.8, 2.2, 2.4)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[0] > speeds[1] > speeds[3] > 0.0


def test_in_a_friendly_no_robot_releases_the_ball(setup, sight_of):
    robot = Simple(Briefing.of("cyan2", setup))
    command = play(robot, sight_of, 2.5)
    assert command.kick is None and command.drive.vx > 0.5


def turn(league, scenes):
    """Whether the robot has to be outside the penalty area after these scenes."""
    limits = RuleLimits.of(league)
    area_turn = AreaTurn(limits, Area.penalty(league.pitch))
    return [area_turn.has_to_be_out(one, "cyan1") for one in scenes][-1]


IN, OUT = Body(9.5, 0.0, 0.0), Body(7.5, 0.0, 0.0)


@pytest.mark.parametrize(
    ("me", "mate", "ball", "has_to"),
    [
        (OUT, (3, 9.5, 1.0), (9.0, 0.0), True),
        (OUT, (3, 9.5, 1.0), (7.6, 0.0), True),
        (IN, (3, 8.0, 0.0), (9.4, 0.0), False),
        (IN, (3, 8.0, 0.0), (8.1, 0.0), True),
        (IN, (3, 9.5, 1.0), (9.5, 0.2), False),
        (OUT, (1, 9.5, 1.0), (9.0, 0.0), False),
    ],
)
def test_where_a_second_robot_is_a_foul_at_once_a_robot_waits_until_the_other_has_left(league, me, mate, ball, has_to):
    assert turn(league, [scene(ball, me, mates=[mate])]) is has_to


def test_a_robot_with_the_ball_waits_before_the_area_until_its_teammate_has_left(league):
    assert turn(league, [scene((7.8, 0.0), OUT, holding=True, mates=[(3, 9.5, 1.0)])])


@pytest.mark.parametrize(("seconds", "has_to"), [(7.9, False), (8.1, True)])
def test_a_robot_leaves_the_penalty_area_before_its_time_is_up(league, seconds, has_to):
    assert turn(league, [scene((9.4, 0.0), IN)] * round(seconds / 0.02)) is has_to


@pytest.mark.parametrize(("away", "has_to"), [(2.0, True), (3.2, False)])
def test_it_comes_back_when_half_of_its_time_is_left(league, away, has_to):
    stay = [scene((9.4, 0.0), IN)] * round(8.1 / 0.02)
    assert turn(league, stay + [scene((9.4, 0.0), OUT)] * round(away / 0.02)) is has_to


def test_the_second_of_two_stays_out_of_the_penalty_area_while_the_nearer_one_is_in_it(league, sight_of):
    """The first plays the ball there; the second, which wants to hold its place near it, comes no nearer."""
    front = league.pitch.goal_line - league.pitch.penalty_area_depth
    robot = Simple(Briefing.of("cyan2", league))
    word = ReceivedRadio(age=0.0, self=Motion(x=-10.0, y=2.0, heading=0.0), role="striker")
    seen = {"ball": (-10.2, 2.2), "radio": {"cyan3": word}, "at": (-front + 0.1, 0.5, 0.0)}
    for tick in range(3):
        drive = robot.act(sight_of(tick, **seen)).drive
    assert drive.vx > -0.1
