"""The referee with eleven robots a side: places for all of them, on the field and beside it."""

import itertools
import math
from dataclasses import replace

import pytest

from schemas.side import Side
from schemas.soccer.game import GameStage, OffField, Phase
from sim_host.soccer.referee.game.participation import Absence, Participation
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.timing import Timing
from sim_host.soccer.referee.placement.bench import bench_pose, entry_pose
from sim_host.soccer.referee.placement.positions import position_faults
from support.referee_rig import RefereeRig

RESTARTS = {
    "kick_off": None,
    "free_kick": (3.0, 2.0),
    "goal_kick": (-7.0, 0.0),
    "throw_in": (4.0, 6.0),
    "corner": (8.0, 5.0),
    "penalty": None,
    "drop_ball": (-2.0, -3.0),
}
"""Action → place that is named, m."""


def crowd(rig, spot):
    """All robots in rows around a spot, nearly touching each other."""
    apart = 2.0 * rig.hull + 0.05
    for place, name in enumerate(rig.roster.names):
        row, column = divmod(place, 6)
        rig.robots[name] = (spot[0] + apart * (column - 2.5), spot[1] + apart * (row - 1.5))


def assert_apart(rig):
    for (one, at), (other, there) in itertools.combinations(rig.robots.items(), 2):
        assert math.dist(at, there) >= 2.0 * rig.hull, f"{one} overlaps {other}"


def assert_all_are_moved(rig):
    """From a crowd around the ball, to legal positions apart from each other."""
    restart = rig.state.restart
    crowd(rig, restart.spot)
    rig.until(lambda state: state.running, rig.book.restarts.positions_limit + 5.0)
    assert_apart(rig)
    assert position_faults(rig.constants, rig.state, restart, rig.snapshot()) == ()
    assert len({event.robot for event in rig.events if event.rule == "positions"}) > 10


@pytest.mark.parametrize("profile", ["msl", "paper"])
@pytest.mark.parametrize("action", RESTARTS)
def test_a_crowd_of_twenty_two_is_moved_to_legal_positions_apart_from_each_other(profile, action):
    rig = RefereeRig(profile, "eleven", size=11)
    rig.playing()
    rig.ask("stop")
    (reply,) = rig.ask(action, None if action == "drop_ball" else Side.CYAN, RESTARTS[action]).replies
    assert reply.accepted, reply.reason
    rig.until(lambda state: state.phase is Phase(action))
    assert_all_are_moved(rig)


@pytest.mark.parametrize("profile", ["msl", "paper"])
def test_at_a_shoot_out_twenty_robots_have_legal_places_beyond_the_halfway_line(profile):
    rig = RefereeRig(profile, "eleven", size=11, winner=True, duration=2.0)
    rig.until(lambda state: state.stage is GameStage.SHOOT_OUT and state.phase is Phase.PENALTY, 400.0)
    assert_all_are_moved(rig)


def off_field(names):
    absences = dict.fromkeys(names, Absence(OffField.REPAIR))
    return RefereeState(Phase.PLAY, Timing(900.0), Side.CYAN)._replace(participation=Participation(absences=absences))


@pytest.mark.parametrize("size", [(22.0, 14.0), (18.0, 12.0), (9.0, 6.0)])
def test_the_benches_have_places_for_all_robots_apart_beyond_the_boundary_and_beside_the_pitch(size):
    rig = RefereeRig("msl", "eleven", size=11)
    pitch = replace(rig.pitch, length=size[0], width=size[1])
    match = replace(rig.constants, pitch=pitch)
    poses = {name: bench_pose(match, off_field(rig.roster.names), name) for name in rig.roster.names}
    for (one, at), (other, there) in itertools.combinations(poses.items(), 2):
        assert math.dist((at.x, at.y), (there.x, there.y)) >= 2.0 * rig.hull + 0.19, f"{one} overlaps {other}"
    for pose in poses.values():
        assert abs(pose.y) - rig.hull > pitch.touch_line + pitch.border
        assert abs(pose.x) + rig.hull <= pitch.goal_line + pitch.border


@pytest.mark.parametrize("size", [(22.0, 14.0), (9.0, 6.0)])
def test_a_bench_has_no_second_row_as_long_as_the_first_has_a_place(size):
    rig = RefereeRig("msl", "eleven", size=11)
    pitch = replace(rig.pitch, length=size[0], width=size[1])
    match = replace(rig.constants, pitch=pitch)
    places = [bench_pose(match, off_field(rig.roster.names), name) for name in rig.roster.names[:11]]
    first = [place for place in places if place.y == max(one.y for one in places)]
    to_the_next = 2.0 * rig.hull + 0.2
    has_room = min(place.x for place in first) - to_the_next - rig.hull >= -(pitch.goal_line + pitch.border)
    assert len(first) == len(places) or not has_room


@pytest.mark.parametrize("ball", [(0.0, 0.0), (-4.0, -7.0)])
def test_eleven_robots_come_back_in_one_stoppage_apart_on_the_field_and_clear_of_the_ball(ball):
    """With the ball at the touch line of their bench, the places beside it are too near."""
    rig = RefereeRig("msl", "eleven", size=11)
    rig.ball = (*ball, rig.radius)
    mine = rig.roster.names[:11]
    for place, name in enumerate(mine):
        rig.robots[name] = (-0.8 * place - 1.0, -9.0)
    for place, name in enumerate(mine):
        pose = entry_pose(rig.constants, off_field(mine[place:]), rig.snapshot(), name)
        assert pose is not None, f"no place for {name}"
        rig.robots[name] = (pose.x, pose.y)
    for name in mine:
        x, y = rig.robots[name]
        assert -rig.pitch.goal_line <= x < 0.0
        assert abs(y) + rig.hull <= rig.pitch.touch_line
        assert math.dist((x, y), ball) - rig.hull >= rig.book.restarts.opponent_distance
    assert_apart(rig)


def test_more_robots_than_the_rule_book_allows_in_a_penalty_area_are_named_with_the_number_allowed():
    rig = RefereeRig("msl", "eleven", size=11)
    rig.playing()
    for number in range(2, 5):
        rig.robots[f"cyan{number}"] = (9.2, 0.8 * number)
    rig.run(rig.book.areas.penalty_area_duration + 1.0)
    assert not [event for event in rig.events if event.rule == "penalty_area"]
    rig.robots["cyan11"] = (9.2, 0.0)
    rig.run(rig.book.areas.penalty_area_duration + 1.0)
    (foul,) = [event for event in rig.events if event.rule == "penalty_area" and event.kind == "foul"]
    assert "at most 3 of a side allowed" in foul.text and "cyan11" in foul.text
