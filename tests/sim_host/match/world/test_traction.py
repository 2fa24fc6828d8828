"""The drive `traction` of profile msl against closed forms: straight ahead, in turns, and in reverse."""

import cmath
import math
from itertools import pairwise

import pytest
from pytest import approx

from schemas.config.profile import load_profile
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive
from support.world_rig import WorldRig, two_a_side

MSL = load_profile("msl")
GAIN, GRIP, TICK = MSL.drive.acceleration, MSL.drive.deceleration, MSL.time.tick


@pytest.fixture
def rig():
    rig = WorldRig(MSL, two_a_side(MSL))
    rig.place(cyan1=(0, 0, 0), ball=(0, 6.5, 0))
    yield rig
    rig.world.close()


def velocities(rig, seconds, **demand):
    """The velocities of cyan1 in the field frame at the end of each tick, x + iy, beginning with the present one."""
    robot = rig.at("cyan1")
    found = [complex(robot.vx, robot.vy)]
    for _ in range(round(seconds / TICK)):
        rig.tick(cyan1=AppliedInput(Drive(**demand), dribble=False))
        robot = rig.at("cyan1")
        found.append(complex(robot.vx, robot.vy))
    return found


def accelerations(found):
    return [abs(after - before) / TICK for before, after in pairwise(found)]


@pytest.mark.parametrize("turn", [0.0, 2.0, 8.0])
@pytest.mark.parametrize(("vx", "vy"), [(4.0, 0.0), (-4.0, 0.0), (2.5, 3.0), (0.0, 1.0)])
def test_no_more_than_the_grip_acts_on_a_robot_however_it_drives_and_turns(rig, vx, vy, turn):
    """5 m/s² in the field frame, within 1 %, from rest through two seconds and while it brakes."""
    found = velocities(rig, 2.0, vx=vx, vy=vy, omega=turn) + velocities(rig, 1.0)[1:]
    assert max(accelerations(found)) <= GRIP * 1.01
    assert abs(found[-1]) == approx(0.0, abs=1e-6)


def test_a_robot_gains_speed_at_its_acceleration_and_brakes_at_its_deceleration(rig):
    """4 m/s after 1.6 s and 3.2 m; at rest 0.8 s and 1.6 m later; each within 1 %."""
    velocities(rig, 1.6, vx=4.0)
    assert rig.at("cyan1").vx == approx(4.0, rel=0.01) and rig.at("cyan1").x == approx(3.2, rel=0.01)
    velocities(rig, 0.8)
    assert rig.at("cyan1").vx == approx(0.0, abs=0.02) and rig.at("cyan1").x == approx(4.8, rel=0.01)


@pytest.mark.parametrize(("speed", "turn"), [(1.0, 2.0), (2.0, 2.0), (0.6, 8.0)])
def test_a_circle_within_the_grip_is_driven_as_demanded(rig, speed, turn):
    """v·ω is at most 5 m/s²: the radius is v / ω within 1 %, and the body points along the way."""
    velocities(rig, 2.0, vx=speed, omega=turn)
    places = []
    for _ in range(math.ceil(2 * math.pi / turn / TICK)):
        rig.tick(cyan1=AppliedInput(Drive(vx=speed, omega=turn), dribble=False))
        robot = rig.at("cyan1")
        places.append(complex(robot.x, robot.y))
        along = complex(robot.vx, robot.vy) * cmath.exp(-1j * robot.heading)
        assert abs(along) == approx(speed, rel=0.01)
        assert cmath.phase(along) == approx(0.0, abs=turn * TICK)  # a tick is driven with one direction
    width = max(place.real for place in places) - min(place.real for place in places)
    assert width == approx(2 * speed / turn, rel=0.02)


@pytest.mark.parametrize(("speed", "turn"), [(4.0, 8.0), (4.0, 2.0), (3.0, 4.5)])
def test_a_circle_beyond_the_grip_is_driven_more_slowly(rig, speed, turn):
    """At GRIP / ω: no algorithm may win by driving at full speed and turning on the spot at once."""
    velocities(rig, 4.0, vx=speed, omega=turn)
    driven = [abs(one) for one in velocities(rig, 2.0, vx=speed, omega=turn)]
    assert sum(driven) / len(driven) == approx(GRIP / turn, rel=0.05)


def test_a_demand_for_the_opposite_direction_brakes_first(rig):
    """From 4 m/s to rest in 0.8 s at 5 m/s², then to -4 m/s in 1.6 s at 2.5 m/s², within two ticks."""
    velocities(rig, 2.0, vx=4.0)
    found = velocities(rig, 2.6, vx=-4.0)
    at_rest = next(number for number, one in enumerate(found) if one.real <= 0.0) * TICK
    there = next(number for number, one in enumerate(found) if one.real <= -3.99) * TICK
    assert at_rest == approx(0.8, abs=2 * TICK)
    assert there == approx(2.4, abs=3 * TICK)
