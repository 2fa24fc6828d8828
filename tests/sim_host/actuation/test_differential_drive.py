"""The differential drive: what robots on two wheels make of their commands, alone and pushed."""

import math
from collections.abc import Iterator
from dataclasses import replace

import pytest
from pytest import approx

from schemas.config.profile import load_profile
from schemas.config.quantity import Choice, meanings
from schemas.config.robot_model import RobotModel
from schemas.config.rolling import GRAVITY
from schemas.config.sections import DriveLimits
from sim_host.actuation.drives import DRIVES
from sim_host.snapshot import RobotState
from support.world_rig import WorldRig, two_a_side
from support.world_rig import tell as drive

PROFILE = load_profile("differential")
MODEL = RobotModel.standard(PROFILE)
LIMITS, WHEELS = MODEL.drive, MODEL.wheels


@pytest.fixture
def field() -> Iterator[WorldRig]:
    field = WorldRig(PROFILE, two_a_side(PROFILE))
    field.place(cyan1=(0, 0, 0), ball=(0, 6.5, 0))
    yield field
    field.world.close()


def in_body(robot: RobotState) -> complex:
    return complex(robot.vx, robot.vy) * complex(math.cos(robot.heading), -math.sin(robot.heading))


def test_the_table_of_drives_has_a_row_for_each_word_of_a_profile() -> None:
    words = meanings(DriveLimits)["model"]
    assert isinstance(words, Choice)
    assert tuple(DRIVES) == words.options


def test_a_robot_drives_straight_at_its_limits_and_stops_at_them(field: WorldRig) -> None:
    """v²/2a to the top speed, and v²/2b from it; within a step's way. The stop is exact."""
    top = LIMITS.max_speed
    field.run(top / LIMITS.acceleration + 0.02, cyan1=drive(20.0))
    at = field.at("cyan1")
    assert (at.vx, at.vy, at.omega) == approx((top, 0, 0), abs=1e-9)
    assert at.x == approx(top**2 / (2 * LIMITS.acceleration), abs=0.02 * top)
    field.run(top / LIMITS.deceleration + 0.02)
    assert field.at("cyan1").vx == approx(0, abs=1e-12)
    assert field.at("cyan1").x - at.x == approx(top**2 / (2 * LIMITS.deceleration), abs=0.02 * top)
    assert field.at("cyan1").y == approx(0, abs=1e-9)


def test_a_robot_turns_in_place(field: WorldRig) -> None:
    field.run(2.0, cyan1=drive(omega=3.0))
    at = field.at("cyan1")
    assert at.omega == approx(3.0, abs=1e-9)
    assert (at.x, at.y) == approx((0, 0), abs=1e-9)


@pytest.mark.parametrize(("speed", "turn_rate"), [(20.0, 10.0), (1.6, 4.0), (-1.5, 5.0), (0.3, 50.0)])
def test_beyond_the_limits_of_the_wheels_the_curvature_is_kept(field: WorldRig, speed: float, turn_rate: float) -> None:
    """Both wheels are slowed by the same factor; the path is a circle of the radius speed / turn rate."""
    field.run(2.0, cyan1=drive(speed, omega=turn_rate))
    at = field.at("cyan1")
    ahead = in_body(at).real
    assert at.omega / ahead == approx(turn_rate / speed, rel=1e-3)
    fastest = abs(ahead) + WHEELS.arm * abs(at.omega)
    assert fastest == approx(min(WHEELS.max_speed, fastest), rel=1e-3)
    assert fastest == approx(WHEELS.max_speed, rel=1e-3) or abs(at.omega) == approx(LIMITS.max_turn_rate, rel=1e-3)
    centre = complex(at.x, at.y) + 1j * complex(at.vx, at.vy) / at.omega
    for _ in range(20):
        field.tick(cyan1=drive(speed, omega=turn_rate))
        at = field.at("cyan1")
        assert abs(complex(at.x, at.y) - centre) == approx(abs(speed / turn_rate), abs=5e-3)


def test_no_demand_moves_a_robot_sideways(field: WorldRig) -> None:
    """A sideways demand changes nothing, not even a bit."""
    states = []
    for aside in (0.0, 3.0):
        field.place(cyan1=(0, 0, 0.3))
        for _ in range(100):
            field.tick(cyan1=drive(1.0, aside, 2.0))
            at = field.at("cyan1")
            assert abs(in_body(at).imag) <= abs(in_body(at).real * at.omega * PROFILE.time.physics_step / 2) + 1e-6
        states.append(at)
    assert states[0] == states[1]
    field.place(cyan1=(0, 0, 0.3))
    field.run(1.0, cyan1=drive(vy=2.0))
    assert field.at("cyan1")[:4] == approx((0, 0, field.at("cyan1").z, 0.3), abs=1e-9)
    assert not field.stuck[0]


def test_a_robot_that_is_hit_from_the_side_slides_and_comes_to_rest(field: WorldRig) -> None:
    """At traction × g: it moves along its axle only while the other's momentum lasts."""
    apart = 2 * MODEL.body.radius
    field.place(cyan1=(0, 0, 0), cyan2=(0, -apart - 1.5, math.pi / 2))
    moved = []
    for _ in range(75):
        field.tick(cyan2=drive(1.6))
        moved.append(field.at("cyan1").vy)
    assert max(moved) > 0.3
    field.run(0.5, cyan2=drive(-1.0))
    at = field.at("cyan1")
    assert at.y > 0.005 and (at.vx, at.vy) == approx((0, 0), abs=1e-6)


def test_an_equal_robot_cannot_push_a_standing_one_along_its_axle(field: WorldRig) -> None:
    """Grip against grip: it creeps, slower than 0.1 m/s."""
    apart = 2 * MODEL.body.radius
    field.place(cyan1=(0, 0, 0), cyan2=(0, -apart, math.pi / 2))
    field.run(1.0, cyan2=drive(1.6))
    assert field.at("cyan1").y < 0.1


def test_a_robot_at_a_wall_is_stuck_and_one_that_drives_on_is_not(field: WorldRig) -> None:
    reach = PROFILE.field.goal_line + PROFILE.field.border - MODEL.body.radius
    field.place(cyan1=(reach, 3.0, 0), cyan2=(0, 0, 0))
    field.run(1.5, cyan1=drive(1.5), cyan2=drive(1.5, omega=1.0))
    assert field.stuck[:2] == [True, False]
    field.run(1.0, cyan1=drive(-1.5))
    assert not field.stuck[0]


def test_a_robot_slides_outward_on_a_circle_that_its_tyres_cannot_hold() -> None:
    """It slows down to traction × g / turn rate, within a fifth, and moves to the right while it turns left."""
    slippery = replace(MODEL, wheels=replace(WHEELS, traction=0.1))
    field = WorldRig(PROFILE, replace(two_a_side(PROFILE), models=(slippery,) * 4))
    field.place(cyan1=(0, 0, 0), ball=(0, 6.5, 0))
    field.run(2.0, cyan1=drive(1.0, omega=2.5))
    moves = in_body(field.at("cyan1"))
    assert abs(moves) == approx(0.1 * GRAVITY / 2.5, rel=0.2)
    assert moves.imag < -0.05
    field.world.close()
