"""Robots of both motion models in the world: among walls, obstacles and each other."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from pytest import approx

from schemas.config.profile import Profile, load_profile
from schemas.config.robot_model import RobotModel
from support.world_rig import WorldRig, two_a_side
from support.world_rig import tell as drive

VELOCITY, TRACTION, OMNI, THREE = (load_profile(name) for name in ("ideal", "msl", "omni", "omni3"))
NAMES = ("cyan1", "cyan2", "magenta1", "magenta2")


def like(profile: Profile, mass: float | None = None, **wheels: Any) -> RobotModel:
    """A robot of a profile, of another mass or on other wheels."""
    model = RobotModel.standard(profile)
    body = replace(model.body, mass=mass or model.body.mass)
    return replace(model, body=body, wheels=replace(model.wheels, **wheels))


def field_of(*models: RobotModel, profile: Profile = OMNI) -> WorldRig:
    """Two a side, the first of these models and the rest standard; the ball far from where robots are put."""
    every = (*models, *[RobotModel.standard(profile)] * (4 - len(models)))
    field = WorldRig(profile, replace(two_a_side(profile), models=every))
    field.place(ball=(0, 6.5, 0))
    return field


def push_each_other(field: WorldRig, seconds: float = 3.0) -> float:
    """cyan1 and magenta1 meet at x = 0, driving at each other; how far cyan1 has pushed the other back, m."""
    r = field.roster.models[0].body.radius
    field.place(cyan1=(-r, 0, 0), magenta1=(r, 0, math.pi))
    field.run(seconds, cyan1=drive(2), magenta1=drive(2))
    return (field.at("cyan1").x + field.at("magenta1").x) / 2


@pytest.fixture(params=["msl", "ideal", "omni", "omni3"])
def field(request: pytest.FixtureRequest) -> Iterator[WorldRig]:
    field = field_of(profile=load_profile(request.param))
    yield field
    field.world.close()


def test_robots_of_each_model_reach_the_demanded_velocity_in_their_own_frame(field: WorldRig) -> None:
    """Body-frame velocities in m/s and rad/s, after a second within 2 %."""
    field.place(cyan1=(0, 0, 2.0))
    field.run(1.0, cyan1=drive(1.0, 0.5, 0.8))
    at = field.at("cyan1")
    in_body = complex(at.vx, at.vy) * complex(math.cos(at.heading), -math.sin(at.heading))
    assert (in_body.real, in_body.imag, at.omega) == approx((1.0, 0.5, 0.8), abs=0.025)
    field.run(1.0)
    at = field.at("cyan1")
    assert (at.vx, at.vy, at.omega) == approx((0, 0, 0), abs=1e-6)
    assert at.z == approx(0.399, abs=1e-6)


def test_the_duel_is_won_by_the_difference_of_grips() -> None:
    """Both wheels spin: acceleration (mu1 − mu2)·g / 2√2 of two equal masses, from 0.2 s on; within 5 %."""
    strong, weak = like(OMNI, traction=0.9), like(OMNI, traction=0.6)
    field = field_of(strong, weak, weak)
    push_each_other(field, 0.3)
    before = field.at("magenta1").vx
    field.run(0.4, cyan1=drive(4), magenta1=drive(4))
    assert field.at("magenta1").vx - before == approx(0.3 * 9.81 / (2 * math.sqrt(2)) * 0.4, rel=0.05)
    field.world.close()


def test_teams_may_be_mixed() -> None:
    """A robot of each model beside the other: each moves as among its like, to 1e-9."""
    mixed = field_of(like(VELOCITY), like(OMNI), like(THREE), like(VELOCITY))
    ends = []
    for alone in (None, VELOCITY, OMNI, THREE):
        field = mixed if alone is None else field_of(profile=alone)
        field.place(cyan1=(-3, 3, 0), cyan2=(-3, 1, 1), magenta1=(-3, -1, 2), magenta2=(-3, -3, 3))
        field.run(1.0, **dict.fromkeys(NAMES, drive(1, 0.5, 1)))
        ends.append([field.at(name) for name in NAMES])
        field.world.close()
    together, velocity, omni, three = ends
    for mine, among_its_like in zip(together, (velocity[0], omni[1], three[2], velocity[3]), strict=True):
        assert mine == approx(among_its_like, abs=1e-9)
    assert abs(omni[0].y - velocity[0].y) > 3e-3 and abs(omni[0].y - three[0].y) > 1e-4


def test_a_robot_that_no_torque_could_turn_in_the_engine_turns_on_its_wheels() -> None:
    """The paper's robot has no moment of inertia about x and y, for which the engine answers no torque at all."""
    paper = load_profile("paper")
    model = RobotModel.standard(paper)
    field = field_of(replace(model, drive=replace(model.drive, model="omni")), profile=paper)
    field.place(cyan1=(0, 0, 0))
    field.run(1.5, cyan1=drive(omega=2))
    assert field.at("cyan1").omega == approx(2, abs=0.01)
    field.world.close()


@pytest.mark.parametrize("profile", [TRACTION, OMNI, THREE], ids=["traction", "four wheels", "three wheels"])
def test_a_rebuilt_world_depends_on_poses_and_velocities_alone(profile: Profile) -> None:
    """Rim speeds are derived again at a checkpoint: another past makes no difference, to the last bit."""
    live, other = field_of(profile=profile), field_of(profile=profile)
    live.place(cyan1=(-1.5, 0.1, 0), magenta1=(1.5, -0.1, math.pi))
    chase = {"cyan1": drive(3, omega=0.3), "magenta1": drive(3, omega=-0.2)}
    live.run(0.8, **chase)
    other.run(0.5, cyan1=drive(3, 1, 1))
    live.copy_to(other)
    for _ in range(75):
        live.tick(**chase)
        other.tick(**chase)
        assert live.engine.packed() == other.engine.packed()
    live.world.close()
    other.world.close()


def test_the_model_may_change_while_robots_drive() -> None:
    """A world made anew with wheels: who drove at 2 m/s does so still, and brakes within the new limit."""
    field = field_of(profile=VELOCITY)
    field.place(cyan1=(-6, 0, 0.4))
    field.run(1.5, cyan1=drive(2, 0.5))
    before = field.at("cyan1")
    field.world.rebuild_with(OMNI, replace(field.roster, models=(like(OMNI),) * 4), ())
    field.tick(cyan1=drive(2, 0.5))
    after = field.at("cyan1")
    assert (after.vx, after.vy) == approx((before.vx, before.vy), abs=1e-3)
    field.run(0.2)
    slowed = math.hypot(before.vx, before.vy) - math.hypot(field.at("cyan1").vx, field.at("cyan1").vy)
    assert slowed == approx(0.2 * OMNI.drive.deceleration, rel=0.1)
    field.world.close()
