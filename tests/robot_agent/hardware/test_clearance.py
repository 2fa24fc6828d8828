"""The filter for clearance: nearest velocities, and robots that do not touch."""

import math
import random

import pytest
from pytest import approx

from robot_agent.hardware.clearance import keep_clear
from schemas.messages.command import Drive
from schemas.messages.sight import Obstacle
from support.messages import make_setup, make_sight

SETUP = make_setup()
REACH = SETUP.robot.reach


def sight(bodies, at=(0.0, 0.0, 0.0), velocity=(0.0, 0.0, 0.0)):
    made = make_sight(at=at, velocity=velocity)
    return made.replace(obstacles=[Obstacle(x=x, y=y, radius=REACH) for x, y in bodies])


@pytest.mark.parametrize("drive", [Drive(vx=1.0), Drive(vx=-3.0, vy=1.0, omega=2.0), Drive()])
def test_a_demand_with_room_is_the_same_object(drive):
    assert keep_clear(drive, sight([(6.0, 0.0)]), SETUP, 0.2) is drive


def test_a_robot_that_is_too_near_is_driven_away_and_may_turn():
    found = keep_clear(Drive(vx=1.0, omega=3.0), sight([(2 * REACH + 0.05, 0.0)]), SETUP, 0.2)
    assert -0.31 < found.vx < -0.2 and found.vy == approx(0.0, abs=1e-9) and found.omega == 3.0


def test_a_velocity_that_was_measured_wrong_asks_for_no_more_than_top_speed():
    found = keep_clear(Drive(vx=1.0), sight([(3.0, 0.0)], velocity=(300.0, 20.0, 0.0)), SETUP, 0.2)
    assert math.hypot(found.vx, found.vy) <= SETUP.drive.max_speed


@pytest.mark.parametrize("aside", [0.0, 0.01, 0.06, 0.3])
def test_a_robot_between_two_bodies_is_not_driven_out_at_speed(aside):
    between = sight([(0.0, 2 * REACH + 0.02), (aside, -2 * REACH - 0.02)])
    found = keep_clear(Drive(vx=0.1), between, SETUP, 0.2)
    assert math.hypot(found.vx, found.vy) <= 0.6


def test_two_wheels_do_not_drive_off_at_speed_from_a_body_beside_them():
    setup = make_setup("differential")
    beside = sight([(0.03, 2 * setup.robot.reach + 0.02)])
    assert abs(keep_clear(Drive(vx=0.1), beside, setup, 0.2).vx) <= 0.6


def test_along_a_wall_the_robot_goes_on_and_toward_it_stops():
    half = SETUP.pitch.touch_line + SETUP.pitch.border
    near = sight([], at=(0.0, half - REACH - 0.1, 0.0), velocity=(1.0, 0.0, 0.0))
    found = keep_clear(Drive(vx=1.0, vy=1.0), near, SETUP, 0.1)
    assert found.vx == approx(1.0, abs=0.15) and found.vy == approx(0.0, abs=1e-6)


@pytest.mark.parametrize(("side", "drive"), [(1, Drive(vy=3.0)), (-1, Drive(vy=-3.0))])
def test_a_keeper_on_its_line_stops_before_a_post(side, drive):
    pitch = SETUP.pitch
    places = [(-pitch.goal_line, side * y, 0.0) for y in (0.0, pitch.goal_width / 2 - REACH - 0.1)]
    middle, near = (keep_clear(drive, sight([], place), SETUP, 0.1) for place in places)
    assert middle is drive and near.vy == approx(0.0, abs=1e-6)


def test_what_is_found_is_the_nearest_velocity_that_all_bodies_allow():
    """Against all velocities on a grid of 2 cm/s, by what a body each allows alone."""
    dice = random.Random(2)
    for _ in range(20):
        bodies = [(dice.uniform(-1.2, 1.2), dice.uniform(-1.2, 1.2)) for _ in range(3)]
        bodies = [one for one in bodies if math.hypot(*one) > 2 * REACH + 0.15]
        heading = dice.uniform(-3.0, 3.0)
        wanted = Drive(vx=dice.uniform(-0.09, 0.09), vy=dice.uniform(-0.09, 0.09))  # within two ticks
        found = keep_clear(wanted, sight(bodies, (0.0, 0.0, heading)), SETUP, 0.1)
        grid = [Drive(vx=0.02 * x, vy=0.02 * y) for x in range(-5, 6) for y in range(-5, 6)]
        alone = [sight([body], (0.0, 0.0, heading)) for body in bodies]
        allowed = [one for one in grid if all(keep_clear(one, seen, SETUP, 0.1) is one for seen in alone)]
        away = min((math.dist((one.vx, one.vy), (wanted.vx, wanted.vy)) for one in allowed), default=math.inf)
        assert math.dist((found.vx, found.vy), (wanted.vx, wanted.vy)) <= away + 1e-9


def test_two_wheels_stop_before_a_body_and_may_back_away():
    two = make_setup("differential")
    ahead = sight([(two.robot.reach + REACH + 0.1, 0.0)], velocity=(0.3, 0.0, 0.0))
    found = keep_clear(Drive(vx=0.5, omega=1.0), ahead, two, 0.1)
    assert (found.vx, found.omega) == (approx(0.0, abs=1e-9), 1.0)
    back = Drive(vx=-0.2)
    assert keep_clear(back, ahead.replace(self=ahead.self.replace(vx=0.0)), two, 0.1) is back


@pytest.mark.parametrize("seed", range(5))
def test_two_robots_that_drive_at_each_other_do_not_touch(plant, seed):
    """Each sees the other as it was two ticks ago."""
    dice = random.Random(seed)
    one, other = plant(-2.0, dice.uniform(-0.5, 0.5), 0.0, 3.0, 0.0, 0.0), plant(2.0, 0.0, 0.0, -3.0, 0.0, 0.0)
    seen, least = [], math.inf
    for _ in range(200):
        seen.append((one.body, other.body))
        then = seen[max(0, len(seen) - 3)]
        for me, wanted, body in ((one, Drive(vx=3.0), then[1]), (other, Drive(vx=-3.0), then[0])):
            own = me.body
            made = sight([(body.x, body.y)], (own.x, own.y, own.heading), (own.vx, own.vy, own.omega))
            me.step(keep_clear(wanted, made, SETUP, 0.1))
        least = min(least, math.hypot(one.body.x - other.body.x, one.body.y - other.body.y) - 2 * REACH)
    assert least > 0.0
