"""The places of robots off the field: their distances, which people beside a real field know too."""

import math

import pytest

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
