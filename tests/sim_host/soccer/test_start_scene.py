"""Start positions of a half: legal for either side's kick-off."""

import itertools
import math
from dataclasses import replace

import pytest

from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.errors import TouchlineError
from schemas.side import Side
from schemas.soccer.game import Phase
from sim_host.snapshot import BallState, RobotState, RobotStates, Roster, Snapshot
from sim_host.soccer.referee.game.referee_state import RefereeState, Restart
from sim_host.soccer.referee.game.timing import Timing
from sim_host.soccer.referee.match_constants import MatchConstants
from sim_host.soccer.referee.placement.positions import position_faults
from sim_host.soccer.start_poses import start_poses
from sim_host.soccer.start_scene import start_scene


def a_match(profile_name, rules, **overrides):
    config = load_match(None, {"profile": profile_name, **overrides})
    profile, book = load_profile(profile_name), load_rule_book(rules)
    roster = Roster.of(config, profile)
    starts, misplaced = start_poses(roster, profile.field, book.restarts)
    assert not misplaced
    half, settings = book.periods.half_duration, {"kick_off": Side.CYAN, "automatic": True, "starts": starts}
    constants = MatchConstants(book, profile.field, profile.ball, roster, half, **settings)
    state = RefereeState(Phase.PRE_GAME, Timing(half), Side.CYAN)
    robots = RobotStates(
        RobotState(pose.x, pose.y, 0.4, pose.heading, 0.0, 0.0, 0.0, False)
        for pose in (starts[name] for name in roster.names)
    )
    snapshot = Snapshot(0, 0.0, roster, robots, BallState(0, 0, 0.11, 0, 0, 0), None, ())
    return constants, state, snapshot


@pytest.mark.parametrize("taker", list(Side))
@pytest.mark.parametrize("rules", ["friendly", "msl", "paper"])
@pytest.mark.parametrize("profile", ["msl", "paper"])
def test_at_the_start_all_stand_legally_for_a_kick_off_of_either_side(profile, rules, taker):
    """Rule book 10.4: the side that does not kick off 3 m away, to the whole robot, its own side 2 m."""
    constants, state, snapshot = a_match(profile, rules)
    assert position_faults(constants, state, Restart(Phase.KICK_OFF, taker, (0.0, 0.0)), snapshot) == ()


def test_a_robot_with_a_wide_frame_starts_as_far_away_as_its_frame_asks_for():
    wide = {f"cyan{number}": "keeper" for number in range(1, 6)}
    constants, state, snapshot = a_match("msl", "msl", **{"teams.cyan.types": wide})
    kick_off = Restart(Phase.KICK_OFF, Side.MAGENTA, (0.0, 0.0))
    assert position_faults(constants, state, kick_off, snapshot) == ()
    nearest = min(math.hypot(robot.x, robot.y) for robot in snapshot.robots[:5])
    assert nearest > 3.0 + math.hypot(0.245, 0.30)


SIZES = [(1, 1), (2, 7), (6, 6), (11, 1), (11, 11)]


def sizes(cyan, magenta):
    return {"teams.cyan.size": cyan, "teams.magenta.size": magenta}


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("pitch", [(22.0, 14.0), (18.0, 12.0), (12.0, 8.0), (9.0, 6.0), (100.0, 64.0)])
def test_sides_of_any_size_start_legally_and_apart_on_every_pitch_that_has_room(pitch, size):
    profile = load_profile("msl")
    field = replace(profile.field, length=pitch[0], width=pitch[1])
    roster = Roster.of(load_match(None, sizes(*size)), profile)
    starts, misplaced = start_poses(roster, field, load_rule_book("eleven").restarts)
    reach = profile.robot.reach
    assert not misplaced
    assert all(
        math.dist((one.x, one.y), (two.x, two.y)) > 2 * reach for one, two in itertools.combinations(starts.values(), 2)
    )
    for name, side in zip(roster.names, roster.sides, strict=True):
        x, y = starts[name].x * side.attack(1), starts[name].y
        assert -field.goal_line <= x - reach and x + reach <= 0.0
        assert abs(y) + reach <= field.touch_line
        assert math.hypot(x, y) - reach > 3.0


def test_robots_of_a_side_that_start_outside_the_penalty_areas_do_so_on_a_small_pitch_too():
    """More of them than the rules allow would commit illegal defence where they stand."""
    profile = load_profile("msl")
    field = replace(profile.field, length=16.0, width=10.0)
    starts, _ = start_poses(
        Roster.of(load_match(None, sizes(11, 11)), profile), field, load_rule_book("eleven").restarts
    )
    front = field.penalty_area_depth - field.goal_line
    inside = [name for name, at in starts.items() if at.x < front and abs(at.y) < field.penalty_area_width / 2]
    assert inside == ["cyan1"]


def test_a_match_on_a_pitch_without_room_for_its_robots_is_refused_in_one_line():
    profile = load_profile("msl")
    profile = replace(profile, field=replace(profile.field, length=6.0, width=5.0))
    with pytest.raises(TouchlineError) as refusal:
        start_scene(load_match(None, sizes(11, 11)), profile, load_rule_book("eleven").restarts)
    assert str(refusal.value) == (
        "a half of 3 × 5 m has no legal place at the kick-off for cyan3, one of 11 robots of cyan; "
        "have fewer robots, a larger pitch, or a scene"
    )
