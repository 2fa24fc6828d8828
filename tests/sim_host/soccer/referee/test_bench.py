"""The places of robots off the field: their distances, which people beside a real field know too."""

import math
from dataclasses import replace

import pytest

from sim_host.soccer.referee.placement.bench import bench_pose, entry_pose
from support.referee_rig import RefereeRig


@pytest.fixture
def halted() -> RefereeRig:
    rig = RefereeRig("msl").playing()
    rig.ask("stop")
    return rig


def test_the_first_place_is_half_a_metre_from_the_border_and_from_the_halfway_line(halted):
    halted.ask("red_card", robot="cyan1")
    x, y = halted.robots["cyan1"]
    assert x + halted.hull == pytest.approx(-0.5)
    assert y + halted.hull == pytest.approx(-(halted.pitch.touch_line + halted.pitch.border + 0.5))


def test_neighbours_on_the_bench_stand_20_cm_apart(halted):
    for name in ("cyan1", "cyan2"):
        halted.ask("red_card", robot=name)
    (x1, y1), (x2, y2) = (halted.robots[name] for name in ("cyan1", "cyan2"))
    assert (x1 - x2 - 2.0 * halted.hull, y1 - y2) == pytest.approx((0.2, 0.0))


def test_each_side_has_its_bench_along_the_right_touch_line_of_its_half(halted):
    for name in ("cyan1", "magenta1"):
        halted.ask("red_card", robot=name)
    (x, y), (other_x, other_y) = (halted.robots[name] for name in ("cyan1", "magenta1"))
    assert x < 0.0 and y < 0.0
    assert (other_x, other_y) == pytest.approx((-x, -y))


@pytest.mark.parametrize(("robot", "heading"), [("cyan1", math.pi / 2), ("magenta1", -math.pi / 2)])
def test_a_robot_on_the_bench_faces_the_field(halted, robot, heading):
    (placement,) = halted.ask("red_card", robot=robot).placements
    assert placement.body == robot
    assert math.remainder(placement.heading - heading, math.tau) == pytest.approx(0.0)


@pytest.mark.parametrize(("name", "side", "heading"), [("cyan3", 1.0, math.pi / 2), ("magenta3", -1.0, -math.pi / 2)])
def test_a_robot_comes_back_inside_the_right_touch_line_of_its_half_and_faces_the_field(halted, name, side, heading):
    halted.ball = (side * 5.0, 0.0, halted.radius)
    state, snapshot = halted.state._replace(spot=None), halted.snapshot()
    pose = entry_pose(halted.constants, state, snapshot, name)
    inside = halted.pitch.touch_line - halted.hull - 0.2
    assert (pose.x, pose.y) == pytest.approx((-side * (0.5 + halted.hull), -side * inside))
    assert math.remainder(pose.heading - heading, math.tau) == pytest.approx(0.0)


@pytest.mark.parametrize(("air", "is_first"), [(0.21, True), (0.19, False)])
def test_a_place_to_come_back_has_20_cm_of_air_to_a_robot_that_stands_there(halted, air, is_first):
    halted.ball = (5.0, 0.0, halted.radius)
    state = halted.state._replace(spot=None)
    first = entry_pose(halted.constants, state, halted.snapshot(), "cyan3")
    halted.robots["cyan4"] = (first.x, first.y + 2.0 * halted.hull + air)
    again = entry_pose(halted.constants, state, halted.snapshot(), "cyan3")
    assert (again == first) is is_first


def test_a_second_row_on_the_bench_has_20_cm_of_air_to_the_first():
    rig = RefereeRig("msl", "eleven", size=11)
    match = replace(rig.constants, pitch=replace(rig.pitch, length=9.0, width=6.0))
    rows = sorted({bench_pose(match, rig.state, name).y for name in rig.roster.names[:11]}, reverse=True)
    assert rows[0] - rows[1] == pytest.approx(2.0 * rig.hull + 0.2)
