"""What robots perceive: the team frame, the truth when it is perfect, and the same for both sides."""

import math
from dataclasses import fields, replace

import numpy as np
import pytest
from pytest import approx

from schemas.config.match_config import load_match
from schemas.config.noise import sensing_of
from schemas.config.profile import load_profile
from schemas.config.sections import Sensing
from sim_host.snapshot import Roster

ROBOTS = ((-3.0, 1.0, 0.5, 1.0, -0.5, 0.2), (2.0, -4.0, -3.0), (5.0, 0.5, math.pi, -2.0, 0.1, -0.3), (8.0, 3.0, 1.0))
BALL = (1.0, 2.0, 0.5, 3.0, -1.0)
MSL = load_profile("msl").sensing
FAR = {"ball_range": 1000.0, "obstacle_range": 1000.0}


@pytest.fixture
def world(scenery):
    return lambda **sensing: scenery(ROBOTS, BALL, 2, **sensing)


def test_perfect_perception_is_the_truth_in_the_team_frame_at_once(world):
    cyan, _, magenta, _ = world().look()
    assert cyan.own == approx([-3.0, 1.0, 0.5, 1.0, -0.5, 0.2], abs=1e-12)
    assert magenta.own == approx([-5.0, -0.5, 0.0, 2.0, -0.1, -0.3], abs=1e-12)
    assert cyan.ball == approx([1.0, 2.0, 0.5, 3.0, -1.0], abs=1e-12)
    assert magenta.ball == approx([-1.0, -2.0, 0.5, -3.0, 1.0], abs=1e-12)
    for seen in (cyan, magenta):
        assert seen.visible and seen.ball_age == 0.0 and seen.obstacles_age == 0.0 and len(seen.obstacles) == 3


def test_obstacles_are_all_the_others_nearest_first_and_unlabelled_with_their_radius_in_metres(world):
    """Everything is SI, the radius too; simatch mixes metres and centimetres."""
    cyan = world().look()[0].obstacles
    assert [number for row in cyan for number in row] == approx([2, -4, 0.245, 5, 0.5, 0.245, 8, 3, 0.245], abs=1e-12)
    second = np.array(world().look()[1].obstacles)
    assert second[:, :2] == approx(np.array([(5.0, 0.5), (-3.0, 1.0), (8.0, 3.0)]))


def test_after_the_change_of_sides_each_team_still_attacks_plus_x_and_what_it_remembers_turns_with_it(world):
    made = world(latency=0.04)
    for _ in range(5):
        before = made.look()
    made.attacks = -1
    after = made.look()
    for one, other in zip(before, after, strict=True):
        assert other.own[:2] == approx([-one.own[0], -one.own[1]])
        assert math.remainder(other.own[2] - one.own[2] - math.pi, 2 * math.pi) == approx(0, abs=1e-4)
        assert other.ball == approx([-one.ball[0], -one.ball[1], one.ball[2], -one.ball[3], -one.ball[4]])
        assert np.array(other.obstacles) == approx(np.array(one.obstacles) * (-1, -1, 1))
    assert made.look()[0].ball == approx(after[0].ball), "what was under way turned as well"


@pytest.mark.parametrize("sensing", [sensing_of("perfect", MSL), MSL, sensing_of("paper", MSL)])
def test_both_sides_of_a_mirrored_world_perceive_alike(scenery, sensing: Sensing):
    """The teams change places, each robot keeps its name; equal to rounding, for 50 ticks."""
    names = {"teams.cyan.robots": ["ann", "bob"], "teams.magenta.robots": ["cat", "dan"]}
    swapped = {"teams.cyan.robots": ["cat", "dan"], "teams.magenta.robots": ["ann", "bob"]}
    profile = load_profile("msl")
    turned = [(-r[0], -r[1], math.remainder((*r, 0.0)[2] + math.pi, math.tau)) for r in ROBOTS]
    moving = [(*t, -vx, -vy, omega) for t, (*_, vx, vy, omega) in zip(turned, map(_full, ROBOTS), strict=True)]
    here = scenery(ROBOTS, BALL, 2, sensing=sensing, roster=Roster.of(load_match(None, names), profile))
    x, y, z, vx, vy = BALL
    there = scenery(
        moving[2:] + moving[:2],
        (-x, -y, z, -vx, -vy),
        2,
        sensing=sensing,
        roster=Roster.of(load_match(None, swapped), profile),
    )
    for _ in range(50):
        one, other = here.look(), there.look()
        for mine, theirs in zip(one, other[2:] + other[:2], strict=True):
            assert theirs.own == approx(mine.own, abs=1e-9)
            assert theirs.ball == approx(mine.ball, abs=1e-9)
            assert theirs.visible == mine.visible
            assert np.array(theirs.obstacles) == approx(np.array(mine.obstacles), abs=1e-9)


def _full(robot: tuple[float, ...]) -> tuple[float, ...]:
    return (*robot, 0.0, 0.0, 0.0)[:6]


def test_equal_seeds_perceive_equally_and_others_do_not(world):
    def looks(seed):
        made = world(sensing=MSL, seed=seed)
        return [made.look() for _ in range(20)]

    assert looks(77) == looks(77)
    assert looks(77) != looks(78)


def test_a_robot_that_is_left_out_changes_the_noise_of_no_other_robot(scenery):
    """A draw left out shifts no other: what two robots perceive of themselves, each other and the ball stays."""
    seen = {}
    for robots in (ROBOTS[:2], (*ROBOTS[:2], (-8.0, -3.0), (-8.0, 3.0))):
        made = scenery(robots, BALL, sensing=replace(MSL, occlusion="nothing", **FAR))
        seen[len(robots)] = [made.look() for _ in range(30)]
    for few, many in zip(seen[2], seen[4], strict=True):
        for one, other in zip(few[:2], many[:2], strict=True):
            assert other.own == approx(one.own, abs=1e-12) and other.ball == approx(one.ball, abs=1e-12)
            assert {row for row in one.obstacles if row[0] < 100} <= set(other.obstacles)


@pytest.mark.parametrize("name", ["ball_dropout", "obstacle_dropout"])
def test_the_luck_of_one_thing_leaves_the_noise_of_the_others_alone(world, name):
    """Dropouts are draws of their own."""
    one, other = world(sensing=replace(MSL, **FAR)), world(sensing=replace(MSL, **FAR, **{name: 0.5}))
    for _ in range(40):
        for less, more in zip(other.look(), one.look(), strict=True):
            assert less.own == more.own
            if name == "obstacle_dropout":
                assert less.ball == more.ball and set(less.obstacles) <= set(more.obstacles)
            else:
                assert less.obstacles == more.obstacles


def test_perception_changes_while_it_runs_and_keeps_what_was_seen(world):
    made = world(ball_range=1000.0)
    made.look()
    made.perception.change(replace(sensing_of("perfect", MSL), ball_range=0.1))
    cyan = made.look()[0]
    assert not cyan.visible and cyan.ball_age == approx(0.02) and cyan.ball[:2] == approx([1.0, 2.0])
    made.perception.change(sensing_of("perfect", MSL))
    assert made.look()[0].visible


def test_robots_that_stay_when_others_come_and_go_know_what_they_knew(scenery):
    """The last of four leaves, and another comes in; the ball has been lost before."""
    sensing = replace(sensing_of("perfect", MSL), latency=0.04, ball_range=9.0)
    made = scenery(ROBOTS, BALL, 2, sensing=sensing)
    for _ in range(5):
        made.look()
    made.ball = made.ball._replace(x=500.0)
    for _ in range(3):
        before = made.look()
    names = (*made.roster.names[:3], "magenta9")
    roster = replace(made.roster, names=names)
    made.perception, made.roster = made.perception.with_roster(sensing, roster), roster
    after = made.look()
    for one, other in zip(before[:3], after[:3], strict=True):
        assert other.ball == one.ball is not None and not other.visible
        assert other.ball_age == approx(one.ball_age + 0.02)
        assert len(other.obstacles) == 3
    assert after[3].ball is None and after[3].obstacles == []
    assert len([made.look() for _ in range(3)][-1][3].obstacles) == 3


def test_every_number_of_sensing_changes_what_is_perceived(world):
    """No parameter without effect: each, changed alone, gives other percepts within 300 ticks."""
    others = {"noise_rate": 0.5, "occlusion": "nothing", "camera_rate": 50.0, "drift_time": 1.0, "latency": 0.1}
    base = replace(MSL, ball_range=9.0)
    plain, made = world(sensing=base), {}
    for field in fields(Sensing):
        value = getattr(base, field.name)
        changed = others.get(field.name, value / 2 if isinstance(value, float) else value)
        made[field.name] = world(sensing=replace(base, **{field.name: changed}))
    same = set(made)
    for tick in range(300):
        if tick == 100:  # a robot steps before the ball
            for one in (plain, *made.values()):
                one.move(1, -1.0, 1.5)
        expected = plain.look()
        same = {name for name in same if made[name].look() == expected}
    assert same == set()
