"""The shipped teams with one to eleven robots."""

import itertools
import math

import pytest

from robot_agent.sdk.skills.keep_out import Area
from robot_agent.sdk.world_model import WorldModel
from robot_agent.soccer.skills.search import search_place
from robot_agent.teams.action import Action
from robot_agent.teams.area_turn import AreaTurn
from robot_agent.teams.fair_play import RuleLimits
from robot_agent.teams.nubot.team import HOMES
from robot_agent.teams.reports import radio_message
from robot_agent.teams.simple.formation import APART, CLEAR, places
from robot_agent.teams.simple.roles import Role
from schemas.config.roster import MAX_ROBOTS
from schemas.messages.command import Drive
from schemas.messages.radio import MAX_OBSTACLES
from schemas.soccer.game import GameStage, Point, TeamPhase
from support.messages import make_setup

TEAMS = pytest.mark.parametrize("team", ["simple", "nubot"])
SIZES = pytest.mark.parametrize("size", range(1, MAX_ROBOTS + 1))
PHASES = [*TeamPhase, TeamPhase.PLAY]


@pytest.fixture(scope="module")
def eleven():
    return make_setup(size=11, rules="eleven")


def starting(size):
    return {number: (*HOMES[number - 1], 0.0) for number in range(1, size + 1)}


def drive_for(squad, seconds, **seen):
    for _ in range(round(seconds * 50)):
        squad.move(squad.act(**seen))


def assert_apart(squad):
    reach = squad.setup.robot.reach
    for (one, at), (other, there) in itertools.combinations(squad.poses.items(), 2):
        assert math.dist(at[:2], there[:2]) > 1.9 * reach, f"{one} stands in {other}"


@TEAMS
@SIZES
def test_a_team_of_any_size_plays_and_takes_every_restart_of_both_sides(squad, team, size):
    setup = make_setup(size=size, rules="eleven")
    made = squad(team, starting(size), setup=setup)
    for phase in PHASES:
        spot = Point(x=0.0, y=0.0)
        for running in (False, True):
            for _ in range(6):
                made.move(made.act(ball=(0.0, 0.0), phase=phase, running=running, spot=spot))
    roles = {word.role for word in made.said.values()}
    assert len(roles) > 1 or size == 1


@TEAMS
def test_all_eleven_settle_in_play_apart_from_each_other_and_from_the_ball(squad, team, eleven):
    made = squad(team, starting(11), setup=eleven)
    drive_for(made, 8.0, ball=(1.0, 0.5), phase=TeamPhase.THEIR_FREE_KICK, spot=Point(x=1.0, y=0.5))
    assert_apart(made)
    needed = eleven.restarts.opponent_distance + eleven.robot.reach
    assert all(math.dist(pose[:2], (1.0, 0.5)) > needed - 0.01 for pose in made.poses.values())


@pytest.mark.parametrize("size", [(22.0, 14.0), (18.0, 12.0)])
def test_the_further_places_of_the_formation_are_apart_from_others_and_clear_of_the_ball(eleven, size):
    pitch = type(eleven.pitch)(
        **{name: getattr(eleven.pitch, name) for name in eleven.pitch.__slots__} | {"length": size[0], "width": size[1]}
    )
    for x, y in itertools.product(range(-int(pitch.goal_line), int(pitch.goal_line) + 1, 1), range(-6, 7, 2)):
        found = places((float(x), float(y)), pitch, 0.245, 9)
        assert len({role for role, _ in found}) == 9
        for place, (role, at) in enumerate(found[3:], 3):
            nearest = min(math.dist(at, there) for _, there in found[:place])
            assert nearest >= APART, f"{role}, ball at {x}, {y}"
        for _, at in found:
            assert math.dist(at, (x, y)) >= CLEAR - 1e-9


def test_the_first_places_do_not_depend_on_the_number_of_robots(eleven):
    for ball in ((0.0, 0.0), (8.0, -5.0), (-10.0, 1.0)):
        whole = places(ball, eleven.pitch, 0.245, 9)
        assert all(places(ball, eleven.pitch, 0.245, count) == whole[:count] for count in range(10))
    assert [role for role, _ in whole[:3]] == [Role.DEFENDER, Role.LEFT, Role.RIGHT]


@pytest.mark.parametrize(("allowed", "inside", "waits"), [(1, 0, False), (1, 1, True), (3, 2, False), (3, 3, True)])
def test_a_robot_waits_outside_a_penalty_area_while_as_many_teammates_as_allowed_are_inside(
    squad, eleven, allowed, inside, waits
):
    poses = {2: (8.0, 3.0, 0.0)} | {3 + number: (9.5, 0.8 * number, 0.0) for number in range(inside)}
    made = squad("simple", poses, setup=eleven)
    made.poses |= {"cyan10": (7.0, 0.0, 0.0), "cyan1": (9.9, -1.0, 0.0)}  # not inside, and the goalkeeper
    made.meet()
    limits = RuleLimits.of(eleven)._replace(area_robots=allowed, at_once=False)
    belief = WorldModel(made.brains["cyan2"].briefing).update(made.sight("cyan2", ball=(10.0, 0.0)))
    turn = AreaTurn(limits, Area.penalty(eleven.pitch))
    assert turn.has_to_be_out(belief, "cyan1") is waits
    assert not turn.has_to_be_out(belief._replace(holding=True), "cyan1")


def test_where_no_field_robot_may_enter_a_penalty_area_even_the_one_with_the_ball_waits(squad, eleven):
    made = squad("simple", {2: (8.0, 0.0, 0.0)}, setup=eleven)
    belief = WorldModel(made.brains["cyan2"].briefing).update(made.sight("cyan2", ball=(8.4, 0.0), holding=True))
    turn = AreaTurn(RuleLimits.of(eleven)._replace(area_robots=0), Area.penalty(eleven.pitch))
    assert turn.has_to_be_out(belief, "cyan1")


@TEAMS
@pytest.mark.parametrize("phase", [TeamPhase.OUR_PENALTY, TeamPhase.THEIR_PENALTY])
def test_at_a_shoot_out_all_that_wait_are_on_the_field_outside_the_centre_circle(squad, team, phase, eleven):
    made = squad(team, starting(11), setup=eleven)
    end = 1.0 if phase.ours else -1.0
    seen = {"ball": (7.4 * end, 0.0), "phase": phase, "spot": Point(x=7.4 * end, y=0.0)}
    drive_for(made, 14.0, running=False, game={"stage": GameStage.SHOOT_OUT}, **seen)
    pitch, reach = eleven.pitch, eleven.robot.reach
    waiting = [f"cyan{number}" for number in range(3 if phase.ours else 2, 12)]
    for name in waiting:
        x, y, _ = made.poses[name]
        assert x * end + reach < 0.0, name
        assert math.hypot(x, y) - reach > pitch.centre_circle_radius, name
        assert abs(y) + reach < pitch.touch_line, name
    assert_apart(made)


@TEAMS
def test_all_eleven_park_in_their_own_half(squad, team, eleven):
    made = squad(team, starting(11), setup=eleven)
    drive_for(made, 15.0, ball=(0.0, 0.0), phase=TeamPhase.PARKING)
    assert_apart(made)
    assert all(x < 0.0 and y < -4.0 for x, y, _ in made.poses.values())


def test_eleven_robots_search_for_a_lost_ball_in_different_places(eleven):
    found = [search_place(number, 0.0, eleven.pitch) for number in range(2, 12)]
    assert all(math.dist(one, other) > 2.0 for one, other in itertools.combinations(found, 2))
    assert all(abs(x) < eleven.pitch.goal_line and abs(y) < eleven.pitch.touch_line for x, y in found)


def test_of_more_bodies_than_a_message_holds_a_robot_sends_the_nearest(squad, eleven):
    made = squad("simple", {2: (0.0, 0.0, 0.0)}, setup=eleven)
    far = [(1.0 + 0.3 * number, 0.0) for number in range(MAX_OBSTACLES + 8)]
    belief = WorldModel(made.brains["cyan2"].briefing).update(made.sight("cyan2", opponents=far[::-1]))
    sent = radio_message(belief, Action("", "", Drive())).obstacles
    assert len(belief.opponents) == MAX_OBSTACLES + 8
    assert sorted(place.x for place in sent) == [pytest.approx(x, abs=0.01) for x, _ in far[:MAX_OBSTACLES]]
