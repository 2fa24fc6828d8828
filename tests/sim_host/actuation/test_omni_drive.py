"""The omni drive on an open floor: what robots on wheels make of their commands, against closed forms."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pytest import approx

from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.rolling import GRAVITY
from schemas.messages.command import Drive
from sim_host.actuation.omni_drive import OmniDrive
from sim_host.snapshot import RobotState

TIME = load_profile("omni").time
FOUR, THREE = (RobotModel.standard(load_profile(name)) for name in ("omni", "omni3"))
BOTH = pytest.mark.parametrize("model", [FOUR, THREE], ids=["four wheels", "three wheels"])
Told = tuple[float, float, float]
REST: Told = (0.0, 0.0, 0.0)


def model_with(
    model: RobotModel, drive: dict[str, Any] | None = None, wheels: dict[str, Any] | None = None
) -> RobotModel:
    return replace(model, drive=replace(model.drive, **(drive or {})), wheels=replace(model.wheels, **(wheels or {})))


WILD = {
    "max_speed": 20.0,
    "max_turn_rate": 50.0,
    "acceleration": 50.0,
    "deceleration": 50.0,
    "turn_acceleration": 200.0,
}
"""Limits of a drive that leave it to the wheels."""
FAST = WILD | {"acceleration": 2.0, "turn_acceleration": 8.0}
"""As fast as the wheels can, reached without losing their grip: a robot on three that spin turns as it likes."""


class Floor:
    """Robots on a free pitch, with a force that pulls at them."""

    def __init__(self, *models: RobotModel, headings: list[float] | None = None, speed: complex = 0) -> None:
        self.models = models
        self.drive = OmniDrive(TIME, models)
        self.robots = [
            RobotState(0, 0, 0.4, heading, speed.real, speed.imag, 0, False)
            for heading in headings or [0.0] * len(models)
        ]
        self.time = 0.0

    def tick(self, *told: Told, pull: complex = 0) -> RobotState:
        """One control tick, pulled at with a force in N; the first robot as it is then."""
        for twists in self.drive.plan(self.robots, [Drive(vx=vx, vy=vy, omega=omega) for vx, vy, omega in told], self):
            self._step(twists, pull)
        self.time += TIME.tick
        return self.robots[0]

    def now(self) -> list[RobotState]:
        """The robots as the drive reads them between two steps."""
        return self.robots

    def _step(self, drives: list[tuple[float, float, float]], pull: complex) -> None:
        dt = TIME.physics_step
        for place, (robot, (vx, vy, omega), model) in enumerate(zip(self.robots, drives, self.models, strict=True)):
            v = complex(vx, vy) + pull / model.body.mass * dt
            x, y, heading = robot.x + v.real * dt, robot.y + v.imag * dt, robot.heading + omega * dt
            self.robots[place] = RobotState(x, y, robot.z, heading, v.real, v.imag, omega, False)

    def run(self, seconds: float, *told: Told, pull: complex = 0) -> RobotState:
        for _ in range(round(seconds / TIME.tick)):
            self.tick(*told, pull=pull)
        return self.robots[0]


def in_body(robot: RobotState) -> complex:
    turned = complex(math.cos(robot.heading), -math.sin(robot.heading))
    return complex(robot.vx, robot.vy) * turned


@BOTH
def test_from_rest_to_three_metres_a_second_takes_the_time_of_the_limit(model: RobotModel) -> None:
    """v / a = 1.2 s to 97 % and 3 m/s within 0.1 s more: the wheels follow the limited demand by some 0.02 s.

    simatch's limiter reached 2.97 m/s with the first command.
    """
    floor = Floor(model)
    while floor.tick((3, 0, 0)).vx < 0.97 * 3:
        pass
    assert floor.time == approx(0.97 * 3 / model.drive.acceleration, abs=0.02 + TIME.tick)
    assert floor.run(0.1, (3, 0, 0)).vx == approx(3, abs=1e-2)


@BOTH
def test_the_grip_alone_accelerates_a_robot_whose_wheels_spin(model: RobotModel) -> None:
    """v = mu·g·t / √2 on four wheels, / √3 on three, until the wheels grip; within 1 %."""
    free = model_with(model, WILD)
    gained = free.wheels.traction * GRAVITY / math.sqrt(2 if free.wheels.count == 4 else 3)
    floor = Floor(free)
    floor.run(0.1, (3, 0, 0))
    begin = floor.robots[0].vx
    assert floor.run(0.3, (3, 0, 0)).vx - begin == approx(gained * 0.3, rel=0.01)
    assert floor.run(0.6, (3, 0, 0)).vx == approx(3, abs=1e-2)


def test_weak_motors_take_a_robot_to_its_speed_along_an_exponential() -> None:
    """v = √2·u0·(1 − exp(−t/τ)), τ = (m + 2·m_wheel)·u0 / 2F, along the axis of a robot on four wheels; within 1 %.

    F is a motor's force at the rim at rest, u0 its rim speed without load, m_wheel wheel and rotor seen from the rim.
    """
    weak = model_with(FOUR, WILD, {"stall_torque": 0.3, "max_speed": 6.6})
    wheels = weak.wheels
    force, u0 = wheels.stall_torque * wheels.gear / wheels.radius, wheels.no_load_rim_speed
    rim_mass = (wheels.inertia + wheels.rotor_inertia * wheels.gear**2) / wheels.radius**2
    tau = (weak.body.mass + 2 * rim_mass) * u0 / (2 * force)
    floor = Floor(weak)
    for _ in range(6):
        robot = floor.run(0.5, (20, 0, 0))
        assert robot.vx == approx(math.sqrt(2) * u0 * (1 - math.exp(-floor.time / tau)), rel=0.01)


@BOTH
@pytest.mark.parametrize(
    "degrees",
    [
        *range(0, 360, 60),
        *(pytest.param(one, marks=pytest.mark.long) for one in range(0, 360, 15) if one not in range(0, 360, 60)),
    ],
)
def test_the_top_speed_of_each_direction_is_that_of_the_wheel_that_turns_fastest(
    model: RobotModel, degrees: int
) -> None:
    """v = limit / max |sin(direction − wheel)|: 7.07 m/s along an axis, 5 on a diagonal; to 0.5 %."""
    free = model_with(model, FAST)
    angle, wheels = math.radians(degrees), free.wheels
    hubs = [wheels.angle + 2 * math.pi * number / wheels.count for number in range(wheels.count)]
    top = wheels.max_speed / max(abs(math.sin(angle - hub)) for hub in hubs)
    robot = Floor(free).run(5.0, (20 * math.cos(angle), 20 * math.sin(angle), 0))
    assert abs(in_body(robot)) == approx(top, rel=5e-3)
    assert math.remainder(np.angle(in_body(robot)) - angle, 2 * math.pi) == approx(0, abs=5e-3)


@BOTH
def test_a_full_turn_takes_what_the_wheels_allow(model: RobotModel) -> None:
    """Limit / arm = 24.6 rad/s by the wheels, 8 rad/s by the drive of the profile; to 0.5 %."""
    wheels = model.wheels
    assert Floor(model_with(model, WILD)).run(2.0, (0, 0, 50)).omega == approx(wheels.max_speed / wheels.arm, rel=5e-3)
    floor = Floor(model)
    assert floor.run(2.0, (0, 0, 50)).omega == approx(model.drive.max_turn_rate, rel=5e-3)
    before = floor.robots[0].heading
    floor.run(2 * math.pi / model.drive.max_turn_rate, (0, 0, 50))
    assert floor.robots[0].heading - before == approx(2 * math.pi, abs=model.drive.max_turn_rate * TIME.tick)


@BOTH
def test_driving_and_turning_share_the_wheels_and_keep_their_proportion(model: RobotModel) -> None:
    """Too much for the wheels, though not for the drive: both are shortened alike."""
    told: Told = (2.0, 0.6, 2.0)
    robot = Floor(model_with(model, wheels={"max_speed": 1.5})).run(4.0, told)
    assert robot.omega < 0.75 * told[2]
    assert in_body(robot) / robot.omega == approx(complex(*told[:2]) / told[2], abs=0.03)


@BOTH
def test_speed_does_not_depend_on_the_compass(model: RobotModel) -> None:
    """The same motion in the body at every heading; simatch limited wheels in the field frame."""
    headings = [math.radians(degrees) for degrees in (0, 30, 45, 90, 135, 200, 300)]
    floor = Floor(*[model] * len(headings), headings=headings)
    for _ in range(100):
        floor.tick(*[(6.0, 2.0, 0.5)] * len(headings))
        speeds = [in_body(robot) for robot in floor.robots]
        assert speeds == approx([speeds[0]] * len(speeds), abs=1e-9)
    assert abs(speeds[0]) > 3.5


@BOTH
def test_a_robot_let_go_of_brakes_at_its_limit_and_comes_to_rest_exactly(model: RobotModel) -> None:
    """The demand on the wheels is exactly zero after v / deceleration."""
    floor = Floor(model)
    floor.run(2.0, (3, 0, 0))
    floor.run(3 / model.drive.deceleration + TIME.tick, REST)
    assert not floor.drive._commanded.any()
    assert floor.run(0.5, REST).vx == approx(0, abs=1e-9)


@BOTH
def test_commanded_velocities_never_jump(model: RobotModel) -> None:
    """Within any tick the demanded velocity changes by the limit × the tick at most."""
    floor, random = Floor(model), np.random.default_rng(2)
    before = np.zeros(2)
    for _ in range(200):
        demand = random.normal(size=3) * 3
        floor.tick((demand[0], demand[1], 0.0))
        told = floor.drive._commanded[:2, 0]
        assert math.dist(told, before) <= model.drive.deceleration * TIME.tick + 1e-9
        before = told


@BOTH
def test_a_robot_that_stands_slides_only_when_pulled_beyond_its_grip(model: RobotModel) -> None:
    """Pulled sideways. Its wheels hold mu·m·g/√2 on four and mu·m·g/2 or more on three.

    At 0.9 of that it creeps, below 6 cm/s; at 1.5 of what they can hold at most it gathers speed with the rest.
    """
    weight, mu = model.body.mass * GRAVITY, model.wheels.traction
    least = mu * weight * (math.sqrt(1 / 2) if model.wheels.count == 4 else 1 / 2)
    most = mu * weight * (math.sqrt(1 / 2) if model.wheels.count == 4 else 2 / 3)
    held, slid = Floor(model), Floor(model)
    assert abs(held.run(1.0, REST, pull=0.9j * least).vy) < 0.06
    assert slid.run(1.0, REST, pull=1.5j * most).vy > 0.9 * 0.5 * most / model.body.mass
    assert abs(slid.run(2.0, REST).vy) < 1e-3


@BOTH
def test_a_robot_that_is_held_back_goes_on_pushing_and_knows_it(model: RobotModel) -> None:
    """As strong as its grip; commanded 2 m/s, it does not move against a pull that is stronger."""
    floor = Floor(model)
    robot = floor.run(1.0, (2, 0, 0), pull=-1.2 * model.body.mass * GRAVITY * model.wheels.traction)
    assert robot.vx < 0 and floor.drive.held_back[0]
    assert not Floor(model).drive.held_back[0]


@BOTH
def test_a_robot_that_forgets_goes_on_as_it_moves(model: RobotModel) -> None:
    """Wheels roll without slip at the measured velocity: it neither jerks nor swerves."""
    floor = Floor(model)
    before = floor.run(1.0, (2, 1, 0))
    floor.drive.reset()
    after = floor.tick((2, 1, 0))
    assert (after.vx, after.vy, after.omega) == approx((before.vx, before.vy, before.omega), abs=1e-3)
    moving = Floor(model, speed=2 + 1j)
    assert moving.tick((2, 1, 0)).vx == approx(2, abs=1e-9)
