"""Only the goalkeeper drives into a goal area."""

import math

import pytest

from robot_agent.sdk.bodies import Body
from robot_agent.sdk.skills.go_to import go_to
from robot_agent.sdk.skills.keep_out import MARGIN, Area, keep_out


@pytest.mark.parametrize("end", [1.0, -1.0])
@pytest.mark.parametrize("start", [(7.0, 0.0), (9.0, 4.0), (10.5, 5.0), (8.5, -3.0)])
def test_a_robot_that_wants_into_a_goal_area_stops_before_it(setup, plant, limits, end, start):
    pitch = setup.pitch
    made = plant(end * start[0], start[1], 0.7)
    for _ in range(300):
        wanted = go_to(made.body, end * (pitch.goal_line - 0.3), 0.0, 0.7, limits)
        me = made.step(keep_out(made.body, wanted, Area.goal(pitch), limits))
        deep = me.x * end > pitch.goal_line - pitch.goal_area_depth
        assert not (deep and abs(me.y) < 0.5 * pitch.goal_area_width)


def test_a_robot_inside_comes_out_the_front(setup, plant, limits):
    pitch = setup.pitch
    made = plant(pitch.goal_line - 0.3, 0.5, 1.0)
    for _ in range(100):
        wanted = go_to(made.body, pitch.goal_line, 0.0, 1.0, limits)
        made.step(keep_out(made.body, wanted, Area.goal(pitch), limits))
    assert made.body.x < pitch.goal_line - pitch.goal_area_depth


def test_ways_past_an_area_stay_as_they_are(setup, limits):
    me = Body(5.0, 3.0, math.pi / 2)
    wanted = go_to(me, -5.0, -3.0, 0.0, limits)
    assert keep_out(me, wanted, Area.goal(setup.pitch), limits) == wanted


def test_along_the_line_one_may_drive(setup, limits):
    x = setup.pitch.goal_line - setup.pitch.goal_area_depth - MARGIN - 0.05
    drive = keep_out(Body(x, -1.0, 0.0), go_to(Body(x, -1.0, 0.0), x, 1.0, 0.0, limits), Area.goal(setup.pitch), limits)
    assert drive.vy > 1.0
