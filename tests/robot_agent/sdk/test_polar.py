"""Polar coordinates of what is seen, as readers of sights want them: SI only."""

import math

import pytest

from robot_agent.sdk.bodies import Body
from robot_agent.sdk.polar import Polar, point, polar

ME = Body(1.0, 2.0, math.pi / 2)


@pytest.mark.parametrize(
    ("place", "seen"),
    [
        ((1.0, 5.0), (3.0, 0.0)),
        ((-2.0, 2.0), (3.0, math.pi / 2)),
        ((1.0, -1.0), (3.0, math.pi)),
        ((4.0, 5.0), (math.sqrt(18.0), -math.pi / 4)),
    ],
)
def test_distance_and_bearing_from_the_kicking_direction_in_metres_and_radians(place, seen):
    assert polar(ME, *place) == pytest.approx(seen)
    assert point(ME, Polar(*seen)) == pytest.approx(place)
