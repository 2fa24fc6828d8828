"""What a camera finds: range, occlusion, dropouts; and when it is known: rate, latency, memory."""

import math
from dataclasses import replace

import numpy as np
import pytest
from pytest import approx

from schemas.config.obstacle import ObstacleConfig, Shape
from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from sim_host.sensing.shutter import Shutter
from sim_host.snapshot import ObstacleState

RADIUS = 0.245
HEIGHT = 0.798
HULLS = {"occlusion": "hulls"}


@pytest.mark.parametrize(("distance", "seen"), [(6.99, True), (7.0, True), (7.01, False)])
def test_ball_and_obstacles_are_seen_up_to_their_range(scenery, distance, seen):
    made = scenery([(0, 0), (0, distance)], (distance, 0.0), ball_range=7.0, obstacle_range=7.0)
    one = made.look()[0]
    assert (one.ball is not None) == seen
    assert len(one.obstacles) == seen


def test_ball_and_obstacles_have_ranges_of_their_own(scenery):
    one = scenery([(0, 0), (0, 5)], (5.0, 0.0), ball_range=6.0, obstacle_range=4.0).look()[0]
    assert one.visible and one.obstacles == []


def test_a_ball_never_seen_is_nothing_and_a_lost_one_is_where_it_was_with_its_age(scenery):
    made = scenery([(0, 0)], (9.0, 0.0), ball_range=7.0)
    assert made.look()[0].ball is None
    made.ball = made.ball._replace(x=6.0)
    assert made.look()[0].visible
    made.ball = made.ball._replace(x=8.0)
    for tick in range(1, 50):
        one = made.look()[0]
        assert not one.visible and one.ball[:2] == approx([6.0, 0.0]) and one.ball_age == approx(0.02 * tick)
    made.ball = made.ball._replace(x=5.0)
    assert made.look()[0].ball_age == 0.0


@pytest.mark.parametrize("attacker", [0.0, 1.1, -2.5])
@pytest.mark.parametrize("beside", [0.0, 0.24, -0.24, 0.25, -0.25])
def test_a_hull_on_the_line_of_sight_hides_ball_and_robots_to_its_edge(scenery, attacker, beside):
    """The line from the eye to the ball's centre passes the hull's at `beside` m: hidden within 0.245 m."""
    c, s = math.cos(attacker), math.sin(attacker)
    blocker = (2.0 * c - beside * s, 2.0 * s + beside * c)
    ball, behind = (4.0 * c, 4.0 * s), (6.0 * c, 6.0 * s)
    one = scenery([(0, 0), blocker, behind], ball, **HULLS).look()[0]
    hidden = abs(beside) < RADIUS
    assert (one.ball is None) == hidden
    assert len(one.obstacles) == 2 - hidden


def test_a_hull_behind_the_ball_or_behind_the_eye_hides_nothing(scenery):
    seen = scenery([(0, 0), (4.4, 0), (-1, 0)], (4.0, 0.0), **HULLS).look()
    assert seen[0].visible and len(seen[0].obstacles) == 2
    assert seen[2].ball is None and len(seen[2].obstacles) == 1, "through the one in front of it"


@pytest.mark.parametrize(("height", "seen"), [(0.11, False), (HEIGHT - 0.01, False), (HEIGHT + 0.01, True)])
def test_a_ball_that_flies_above_a_hull_is_seen_over_it(scenery, height, seen):
    one = scenery([(0, 0), (2, 0)], (4.0, 0.0, height), **HULLS).look()[0]
    assert one.visible == seen


def test_a_taller_robot_is_seen_over_a_smaller_one(scenery):
    profile = load_profile("msl")
    tall = replace(profile.robot, height=HEIGHT + 0.1)
    robots = [(0, 0), (2, 0), (4, 0), (6, 0)]
    roster = scenery(robots, (0.0, 5.0)).roster
    standard = RobotModel.standard(profile)
    models = (standard, standard, replace(standard, body=tall), standard)
    seen = scenery(robots, (0.0, 5.0), roster=replace(roster, models=models), **HULLS).look()
    assert [[round(row[0]) for row in one.obstacles] for one in seen] == [[2, 4], [0, 4], [2, 6], [4]]


def box(name, x, y, heading=0.0, size=(0.4, 2.0, 1.0)):
    return ObstacleState.of(ObstacleConfig(name=name, shape=Shape.BOX, place=[x, y], heading=heading, size=list(size)))


def cylinder(name, x, y, radius=0.5, height=1.0):
    return ObstacleState.of(ObstacleConfig(name=name, shape=Shape.CYLINDER, place=[x, y], radius=radius, height=height))


def test_static_obstacles_are_seen_among_the_robots_with_the_radius_of_the_circle_around_them(scenery):
    """Their places are perceived as those of robots: in the team frame, nearest first, unlabelled."""
    made = scenery([(0, 0), (3, 0)], (0.0, 1.0), 1)
    made.obstacles = (cylinder("barrel", 0.0, 2.0), box("wall", -4.0, 0.0, 0.3))
    mine, theirs = made.look()
    expected = [(0, 2, 0.5), (3, 0, RADIUS), (-4, 0, math.hypot(0.2, 1.0))]
    assert np.array(mine.obstacles) == approx(np.array(expected), abs=6e-5)
    assert theirs.obstacles[0] == approx((0.0, 0.0, RADIUS)) and theirs.obstacles[1][:2] == approx((0.0, -2.0))


def test_obstacles_put_down_and_taken_away_while_running_come_and_go_and_change_no_other_noise(scenery):
    noise = {"obstacle_position": 0.05, "ball_position": 0.05, "ball_dropout": 0.1}
    made, plain = (scenery([(0, 0), (3, 0)], (0.0, 1.0), **noise) for _ in range(2))
    for tick in range(60):
        made.obstacles = (cylinder("barrel", 0.0, 2.0),) if 20 <= tick < 40 else ()
        one, other = made.look()[0], plain.look()[0]
        assert one.ball == other.ball and one.visible == other.visible
        assert [row for row in one.obstacles if row[2] == RADIUS] == other.obstacles
        assert len(one.obstacles) == 1 + (20 <= tick < 40)


@pytest.mark.parametrize("heading", [0.0, 0.4, 1.2, math.pi / 2, -2.0])
@pytest.mark.parametrize("aside", [0.0, 0.9, 1.1, -0.9, -1.1, 3.0])
def test_a_box_hides_what_lies_behind_its_own_outline(scenery, heading, aside):
    """A box of 0.4 × 2 m, 3 m away; whether the line meets its outline, by a walk along it in steps of 1 mm."""
    made = scenery([(0, 0)], (6.0, 0.0), **HULLS)
    made.obstacles = (box("wall", 3.0, aside, heading),)
    x = np.arange(0.0, 6.0, 0.001) - 3.0
    c, s = math.cos(heading), math.sin(heading)
    inside = (np.abs(c * x - s * aside) < 0.2) & (np.abs(-s * x - c * aside) < 1.0)
    assert made.look()[0].visible == (not inside.any())


@pytest.mark.parametrize(("x", "seen"), [(1.0, False), (2.7, True), (-1.0, True)])
def test_a_box_beside_behind_or_behind_the_eye_hides_nothing(scenery, x, seen):
    made = scenery([(0, 0)], (2.0, 0.0), **HULLS)
    made.obstacles = (box("wall", x, 0.0),)
    assert made.look()[0].visible == seen


def test_a_ball_is_seen_over_a_low_box_and_a_robot_too(scenery):
    made = scenery([(0, 0), (4, 0)], (2.0, 0.0, 0.11), **HULLS)
    for height, ball, robot in ((0.1, True, True), (0.3, False, True), (1.0, False, False)):
        made.obstacles = (box("wall", 1.0, 0.0, 0.0, (0.4, 2.0, height)),)
        one = made.look()[0]
        assert one.visible == ball
        assert any(row[0] == approx(4.0) for row in one.obstacles) == robot


@pytest.mark.parametrize(("heading", "seen"), [(0.0, False), (math.pi / 2, True), (math.pi, False)])
def test_the_frame_of_a_robot_hides_as_it_stands(scenery, heading, seen):
    """A frame 1 m wide across the front: the line passes 0.4 m beside the robot's middle, along its heading."""
    robots = [(0, 0.4), (2, 0.0, heading)]
    roster = scenery(robots, (4.0, 0.4)).roster
    standard = roster.models[0]
    wide = replace(standard, body=replace(standard.body, frame_width=1.0, frame_depth=0.1))
    one = scenery(robots, (4.0, 0.4), roster=replace(roster, models=(standard, wide)), **HULLS).look()[0]
    assert one.visible == seen
    assert one.obstacles[0][2] == approx(wide.body.reach, abs=6e-5)


def test_a_robot_sees_past_its_own_frame(scenery):
    robots = [(0, 0, 0.0), (4, 0)]
    roster = scenery(robots, (0.4, 0.0)).roster
    standard = roster.models[0]
    wide = replace(standard, body=replace(standard.body, frame_width=1.0, frame_depth=0.1))
    one = scenery(robots, (0.4, 0.0), roster=replace(roster, models=(wide, standard)), **HULLS).look()[0]
    assert one.visible and len(one.obstacles) == 1


def test_without_occlusion_robots_see_through_each_other(scenery):
    one = scenery([(0, 0), (2, 0), (4, 0)], (6.0, 0.0), obstacle_range=10.0).look()[0]
    assert one.visible and len(one.obstacles) == 2


def test_bodies_in_view_are_missed_in_the_configured_share_of_pictures(scenery):
    """4,000 pictures, each robot and thing on its own: within 4 standard errors, and white."""
    n = 4000
    made = scenery([(0, 0), (3, 0)], (0.0, 3.0), ball_dropout=0.1, obstacle_dropout=0.3, obstacle_range=10.0)
    looks = [made.look()[:2] for _ in range(n)]
    rates = {"ball": 0.1, "obstacle": 0.3}
    lost = {
        (kind, place): np.array(
            [not look[place].visible if kind == "ball" else not look[place].obstacles for look in looks]
        )
        for kind in rates
        for place in (0, 1)
    }
    for (kind, _), times in lost.items():
        rate = rates[kind]
        assert times.mean() == approx(rate, abs=4 * math.sqrt(rate * (1 - rate) / n))
        assert np.corrcoef(times[1:], times[:-1])[0, 1] == approx(0, abs=4 / math.sqrt(n))
    matrix = np.corrcoef(list(lost.values())) - np.eye(4)
    assert np.abs(matrix).max() < 4 / math.sqrt(n)


@pytest.mark.parametrize("latency", [0, 1, 2, 5])
@pytest.mark.parametrize("every", [1, 2, 3])
def test_what_is_seen_is_the_newest_picture_that_is_old_enough(scenery, latency, every):
    """The ball's x is the tick: which picture is seen can be read off, and its age agrees."""
    made = scenery([(0, 0)], (0.0, 2.0), camera_rate=50.0 / every, latency=0.02 * latency, obstacle_range=10.0)
    for tick in range(30):
        made.ball = made.ball._replace(x=float(tick))
        made.move(0, 0.0, 0.5 * tick)
        one = made.look()[0]
        if tick < latency:
            assert one.ball is None
            continue
        picture = (tick - latency) // every * every
        assert one.ball[0] == approx(picture) and one.visible
        assert one.ball_age == one.obstacles_age == approx(0.02 * (tick - picture))
        assert one.own[1] == approx(0.5 * tick), "its own motion it knows at once"


def test_when_a_picture_is_developed_makes_no_difference_to_what_is_seen(scenery):
    """The host develops it when the sights are out; otherwise it is developed when it is needed."""
    wanted = {"camera_rate": 25.0, "latency": 0.02, "ball_position": 0.05, "obstacle_position": 0.05}
    at_once, in_time = (scenery([(0, 0), (2, 1)], (1, 1), **wanted) for _ in range(2))
    for tick in range(8):
        for one in (at_once, in_time):
            one.move(1, 2 + 0.1 * tick, 1)
            one.ball = one.ball._replace(x=1 + 0.2 * tick)
        if tick == 5:
            at_once.attacks = in_time.attacks = -1
        seen = at_once.look()
        at_once.perception.develop()
        assert seen == in_time.look()


@pytest.mark.parametrize(
    ("rate", "tick", "taken"), [(30.0, 0.02, 30), (25.0, 0.021, 25), (1000.0, 0.02, 50), (0.1, 0.02, 0)]
)
def test_as_many_pictures_are_taken_in_a_second_as_ticks_allow(rate, tick, taken):
    """Over 1000 s, to one picture; a rate that no whole number of ticks makes comes out on the average."""
    shutter = Shutter.of(replace(load_profile("msl").sensing, camera_rate=rate), tick)
    ticks = round(1000 / tick)
    pictures = [t for t in range(ticks) if shutter.takes(t)]
    assert pictures[0] == 0
    assert len(pictures) == approx(min(1000 * rate, ticks), abs=1)
    assert [shutter.tick_of(number) for number in range(len(pictures))] == pictures
    assert max(np.diff(pictures), default=1) - min(np.diff(pictures), default=1) <= 1
    assert taken in (0, round(len(pictures) / 1000))


def test_of_two_equally_far_bodies_either_side_sees_its_teammate_first(scenery):
    """In roster order it would be cyan's robot for both."""
    here = scenery([(-2.0, 0.0), (0.0, 2.0), (0.0, -2.0), (2.0, 0.0)], (0.0, 5.0), 2).look()
    to_mate = {0: (0.0, 2.0), 1: (-2.0, 0.0), 2: (-2.0, 0.0), 3: (0.0, 2.0)}
    """Robot → its teammate in the frame of its side."""
    for robot, place in to_mate.items():
        assert here[robot].obstacles[0][:2] == place
