"""Two robots at one ball: fair, symmetric, the same for any order of the roster."""

import math
import random
from collections import Counter

import pytest

from schemas.side import Side

SCENES = 12


def scene(number):
    """Two robots that drive at a ball between them: places and headings, the first one's and the second one's."""
    chance = random.Random(number)
    bodies = []
    for side in (-1, 1):
        bearing = chance.uniform(-0.5, 0.5) + (math.pi if side < 0 else 0.0)
        away = chance.uniform(0.45, 0.7)
        heading = bearing + math.pi + chance.uniform(-0.05, 0.05)
        bodies.append((away * math.cos(bearing), away * math.sin(bearing), heading))
    return bodies


def drive_at_it(rig, tell, cyan, magenta, seconds=1.0):
    """What is seen tick by tick while both robots drive at the ball with their dribblers on."""
    rig.place(cyan1=cyan, magenta1=magenta, ball=(0, 0, 0))
    rig.world.make_checkpoint()
    told = tell(1.5, dribble=True)
    for _ in range(round(seconds / rig.profile.time.tick)):
        yield rig.tick(cyan1=told, magenta1=told)


def scenes_and_mirror_images(rig, tell):
    """The same of all scenes, each also turned by π with the sides exchanged."""
    for number in range(SCENES):
        first, second = scene(number)
        yield from drive_at_it(rig, tell, first, second)
        yield from drive_at_it(rig, tell, turned(second), turned(first))


def turned(body):
    x, y, heading = body
    return -x, -y, heading + math.pi


@pytest.mark.parametrize("way", ["pose", "velocity", "force"])
def test_over_scenes_and_their_mirror_images_both_sides_have_the_ball_as_often(build, tell, way):
    """To 10 % of the ticks in which a robot has it."""
    rig = build(dribble={"method": way})
    held = Counter(seen.possession for seen in scenes_and_mirror_images(rig, tell))
    both = held["cyan1"] + held["magenta1"]
    assert both > SCENES * 5
    assert abs(held["cyan1"] - held["magenta1"]) < 0.1 * both


def last_touches(snapshots):
    """Per robot: ticks in which both touch the ball and it is the last; and under None those in which neither is."""
    return Counter(None if seen.level else seen.touches[-1] for seen in snapshots if len(seen.touches) == 2)


@pytest.mark.parametrize(
    "order", [("cyan1", "cyan2", "magenta1", "magenta2"), ("magenta2", "magenta1", "cyan2", "cyan1")]
)
def test_in_ticks_in_which_both_touch_the_ball_each_side_is_the_last_as_often(build, tell, order):
    """Over scenes and their mirror images; by the order of the roster, one of them would always be."""
    last = last_touches(scenes_and_mirror_images(build(order=order), tell))
    decided = last["cyan1"] + last["magenta1"]
    assert decided > SCENES and last[None] > 0
    assert abs(last["cyan1"] - last["magenta1"]) < 0.4 * decided


def test_two_robots_that_press_a_ball_from_both_ends_alike_are_level(build, tell):
    cyan = (-0.5, 0.0, 0.0)
    last = last_touches(drive_at_it(build(), tell, cyan, turned(cyan)))
    assert last[None] > 10 and last["cyan1"] == last["magenta1"] == 0


def test_a_first_touch_belongs_to_the_same_robot_in_any_order_of_the_roster(build, tell):
    """In simatch the last writer has the ball."""
    orders = [("cyan1", "cyan2", "magenta1", "magenta2"), ("magenta2", "magenta1", "cyan2", "cyan1")]
    rigs = [build(order=order) for order in orders]
    winners = []
    for number in range(SCENES):
        cyan, magenta = scene(number)
        first = []
        for rig in rigs:
            snapshots = drive_at_it(rig, tell, cyan, magenta)
            first.append(next((s.possession for s in snapshots if s.possession), None))
        assert first[0] == first[1]
        winners.append(first[0])
    assert {"cyan1", "magenta1"} <= set(winners), "the scenes are not all won by one side"
    assert rigs[0].roster.side_of("cyan1") is Side.CYAN


@pytest.mark.parametrize("way", ["pose", "velocity", "force"])
def test_an_opponent_takes_a_dribbled_ball_by_driving_through_it_from_the_side(build, tell, way):
    rig = build(dribble={"method": way})
    rig.give("cyan1", 0)
    rig.place(magenta1=(rig.profile.dribble.gap, -1.2, math.pi / 2))
    owners = set()
    for _ in range(60):
        owners.add(rig.tick(cyan1=tell(dribble=True), magenta1=tell(3.0, dribble=True)).possession)
    assert "cyan1" in owners
    assert rig.tick(cyan1=tell(dribble=True), magenta1=tell(3.0, dribble=True)).possession != "cyan1"


def head_on(rig, tell, cyan, magenta, seconds=0.6):
    """cyan1 holds the ball and magenta1 comes head-on; their speeds in m/s, and the ball's x after that."""
    rig.give("cyan1", 0)
    rig.place(magenta1=(2 * rig.profile.dribble.gap + 0.02, 0, math.pi))
    start = rig.world.snapshot().ball.x
    return rig.run(seconds, cyan1=tell(cyan, dribble=True), magenta1=tell(magenta, dribble=True)).ball.x - start


@pytest.mark.parametrize("order", [None, ("magenta2", "magenta1", "cyan2", "cyan1")])
def test_a_held_ball_that_is_contested_head_on_goes_the_way_of_the_stronger_robot(build, tell, order):
    """Two that are equal stand off; one of 55 kg pushes back one of 30 kg, whichever the roster names first."""
    assert head_on(build(order=order), tell, 2.0, 2.0) == pytest.approx(0.0, abs=0.03)
    ways = []
    for masses in ({"cyan1": 55.0, "magenta1": 30.0}, {"cyan1": 30.0, "magenta1": 55.0}):
        rig = build(order=order, robots={name: {"body": {"mass": mass}} for name, mass in masses.items()})
        ways.append(head_on(rig, tell, 2.0, 2.0))
    assert ways[0] > 0.1
    assert ways[1] == pytest.approx(-ways[0], abs=0.03)


@pytest.mark.parametrize("stronger", ["cyan1", "magenta1"])
def test_of_two_dribblers_that_draw_at_one_ball_the_stronger_keeps_it(build, tell, stronger):
    """Both back off at 0.5 m/s: the ball follows the dribbler of 5 N, although cyan1 held it first."""
    rig = build(robots={stronger: {"dribble": {"max_pull": 5.0}}})
    head_on(rig, tell, 0.5, 0.5, 0.5)
    for _ in range(60):
        snapshot = rig.tick(cyan1=tell(-0.5, dribble=True), magenta1=tell(-0.5, dribble=True))
    assert snapshot.possession == stronger


def test_two_equal_dribblers_leave_the_ball_between_them_when_they_back_off(build, tell):
    """Their pulls cancel, so that neither gains it by the order of the roster."""
    rig = build()
    head_on(rig, tell, 0.5, 0.5, 0.5)
    snapshot = rig.run(1.0, cyan1=tell(-0.5, dribble=True), magenta1=tell(-0.5, dribble=True))
    assert snapshot.possession is None
    assert snapshot.ball.x == pytest.approx(rig.profile.dribble.gap, abs=0.06)


def test_in_profiles_of_before_only_the_nearest_robot_draws_the_ball(build, tell):
    """`contest` is "nearest" in recordings that do not name it."""
    ways = []
    for contest in ("nearest", "all"):
        rig = build(dribble={"contest": contest})
        rig.give("cyan1", 0)
        rig.place(magenta1=(rig.profile.dribble.gap + 0.39, 0, math.pi))
        rig.run(0.2, cyan1=tell(dribble=True), magenta1=tell(dribble=True))
        ways.append(rig.world.snapshot().ball.x)
    touching = rig.profile.robot.radius + rig.profile.ball.radius
    assert ways[0] == pytest.approx(touching, abs=0.001)
    assert ways[1] > ways[0] + 0.005
