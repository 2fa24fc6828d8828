"""Bodies of robots and fixed objects: sized as in the profile, upright, and never in each other."""

import itertools
import math
import random
from collections.abc import Iterator

import pybullet
import pytest
from pytest import approx

from schemas.config.match_config import load_match
from schemas.config.obstacle import ObstacleConfig, Shape
from schemas.config.profile import load_profile
from sim_host.snapshot import Roster
from support.world_rig import WorldRig
from support.world_rig import tell as drive

DEEP = 0.02
"""m; no body is ever deeper in another."""
CRATE = ObstacleConfig(name="crate", shape=Shape.BOX, place=[1.0, 2.0], heading=0.2, size=[0.4, 2.0, 0.5])
POLE = ObstacleConfig(name="pole", shape=Shape.CYLINDER, place=[-1.5, -2.0], radius=0.15, height=1.0)


def new_pitch(profile: str = "msl", size: int = 5, **types: str) -> WorldRig:
    """A pitch with `size` robots a side, some of other types; robots that a test does not place stay parked."""
    cyan = {name: kind for name, kind in types.items() if name.startswith("cyan")}
    magenta = {name: kind for name, kind in types.items() if name.startswith("magenta")}
    teams = {"cyan": {"size": size, "types": cyan}, "magenta": {"size": size, "types": magenta}}
    numbers = load_profile(profile)
    pitch = WorldRig(numbers, Roster.of(load_match(None, {"profile": profile, "teams": teams}), numbers))
    pitch.place(ball=(0, -numbers.field.touch_line + 1, 0))
    return pitch


@pytest.fixture
def pitch() -> Iterator[WorldRig]:
    pitch = new_pitch()
    yield pitch
    pitch.world.close()


@pytest.mark.parametrize(
    ("profile", "mass", "inertia", "radius", "height"),
    [("msl", 39.0, (50.0, 50.0, 1.625), 0.245, 0.798), ("paper", 31.0, (0.0, 0.0, 2.86), 0.334, 0.912)],
)
def test_loaded_bodies_have_the_mass_the_inertia_and_the_size_of_their_profile(
    profile: str, mass: float, inertia: tuple[float, ...], radius: float, height: float
) -> None:
    """Read back from the engine; the numbers are those of the simulators' own models, but for msl's against tipping."""
    engine = new_pitch(profile, size=1).engine
    dynamics = pybullet.getDynamicsInfo(engine.robots[0], -1, physicsClientId=engine.client)
    assert (dynamics[0], dynamics[2]) == (mass, approx(inertia))
    low, high = pybullet.getAABB(engine.robots[0], -1, physicsClientId=engine.client)
    sizes = [top - bottom for bottom, top in zip(low, high, strict=True)]
    assert sizes == approx([2 * radius, 2 * radius, height], abs=1e-6)
    ball, numbers = pybullet.getDynamicsInfo(engine.ball, -1, physicsClientId=engine.client), load_profile(profile).ball
    assert (ball[0], ball[2][0]) == approx((numbers.mass, numbers.inertia))


def test_a_keeper_is_as_wide_as_its_frame_and_has_its_own_mass() -> None:
    pitch = new_pitch(size=2, cyan1="keeper")
    low, high = pybullet.getAABB(pitch.engine.robots[0], -1, physicsClientId=pitch.engine.client)
    assert (high[0] - low[0], high[1] - low[1]) == approx((0.49, 0.60), abs=1e-6)
    masses = [
        pybullet.getDynamicsInfo(body, -1, physicsClientId=pitch.engine.client)[0] for body in pitch.engine.robots
    ]
    assert masses == [40.0, 39.0, 39.0, 39.0]


def test_a_keepers_frame_stops_a_ball_that_passes_a_round_robot() -> None:
    for kind, passes in (("standard", True), ("keeper", False)):
        pitch = new_pitch(size=1, cyan1=kind)
        pitch.place(cyan1=(0, 0, 0), ball=(1.0, 0.37, 0))
        pitch.engine.set_ball_motion((-5, 0, 0), (0, 0, 0))
        assert (pitch.run(0.4).ball.x < -0.3) == passes


@pytest.mark.parametrize("profile", ["msl", "paper"])
@pytest.mark.parametrize(("lift", "tilt"), [(0.3, 0.0), (0.0, 0.4), (0.2, 1.2), (0.06, 0.0), (0.0, 0.06)])
def test_a_robot_that_is_lifted_or_tipped_is_put_upright_where_it_is(profile: str, lift: float, tilt: float) -> None:
    """simatch puts a robot upright from 0.05 m or 0.05 rad on."""
    pitch = new_pitch(profile, size=1)
    pitch.place(cyan1=(1, 2, 0.5))
    height, body = pitch.profile.robot.height / 2, pitch.engine.robots[0]
    turned = pybullet.getQuaternionFromEuler((tilt, 0.0, 0.5))
    pybullet.resetBasePositionAndOrientation(body, (1, 2, height + lift), turned, pitch.engine.client)
    pitch.tick()
    (x, y, z), orientation = pybullet.getBasePositionAndOrientation(body, pitch.engine.client)
    assert (x, y, z) == approx((1, 2, height), abs=1e-3)
    roll, pitched, heading = pybullet.getEulerFromQuaternion(orientation)
    assert (roll, pitched, heading) == approx((0, 0, 0.5), abs=1e-2)


@pytest.mark.parametrize("profile", ["msl", "omni", "paper"])
@pytest.mark.parametrize(
    "offset", [0.0, 0.018, *(pytest.param(one, marks=pytest.mark.long) for one in (0.004, 0.011, 0.026, 0.033))]
)
def test_two_robots_that_meet_at_top_speed_touch_and_no_more(profile: str, offset: float) -> None:
    """They close 4 cm in a step of the engine: it would notice them one step too late."""
    pitch = new_pitch(profile, size=1)
    pitch.place(cyan1=(-4, 0.02, 0), magenta1=(4 + offset, 0, math.pi))
    nearest, least = math.inf, 2 * pitch.profile.robot.radius
    for _ in range(round(2.5 / pitch.profile.time.tick)):
        one, other = pitch.tick(cyan1=drive(20), magenta1=drive(20)).robots
        nearest = min(nearest, math.hypot(one.x - other.x, one.y - other.y))
    assert least - DEEP < nearest < least + 0.02


@pytest.mark.parametrize(("what", "x", "y"), [("post", 11.06, 1.26), ("wall", 12.2, -5.0), ("bar", 11.06, 0.0)])
def test_a_robot_that_is_driven_at_what_stands_stops_at_it(pitch: WorldRig, what: str, x: float, y: float) -> None:
    for keeper, start in itertools.product((False, True), (0.0, 0.007, 0.013)):
        pitch = new_pitch(size=1, **({"cyan1": "keeper"} if keeper else {}))
        pitch.place(cyan1=(x - 4 + start, y, 0))
        deepest = 0.0
        for _ in range(150):
            pitch.tick(cyan1=drive(20, omega=2.0 if keeper else 0.0))
            deepest = max(deepest, pitch.depth())
        assert deepest < DEEP
        pitch.world.close()


@pytest.mark.parametrize("profile", ["msl", "omni", "paper"])
def test_robots_that_are_pushed_together_by_all_others_do_not_overlap(profile: str) -> None:
    """Ten robots drive at one point for four seconds, in turns with drives of their own."""
    pitch = new_pitch(profile, **({} if profile == "paper" else {"cyan1": "keeper", "magenta1": "keeper"}))
    chance = random.Random(4)
    spots = [(1.3 * x - 2.6, 1.6 * y - 0.8, chance.uniform(-3, 3)) for x in range(5) for y in range(2)]
    pitch.place(**dict(zip(pitch.roster.names, spots, strict=True)))
    snapshot, deepest = pitch.world.snapshot(), 0.0
    for _ in range(round(4 / pitch.profile.time.tick)):
        told = {}
        for name, at in zip(pitch.roster.names, snapshot.robots, strict=True):
            bearing = math.atan2(-at.y, -at.x) - at.heading
            told[name] = drive(20 * math.cos(bearing), 20 * math.sin(bearing), 3.0)
        snapshot = pitch.tick(**told)
        deepest = max(deepest, pitch.depth())
    assert deepest < DEEP


@pytest.mark.parametrize("obstacle", [CRATE, POLE], ids=lambda obstacle: obstacle.name)
def test_an_obstacle_stops_robots_and_the_ball_and_stays_where_it_is(pitch: WorldRig, obstacle: ObstacleConfig) -> None:
    pitch.world.put_obstacle(obstacle)
    x, y = obstacle.place
    pitch.place(cyan1=(x - 2, y, 0), ball=(x + 2, y, 0))
    pitch.engine.set_ball_motion((-6, 0, 0), (0, -6 / 0.11, 0))
    deepest = 0.0
    for _ in range(60):
        snapshot = pitch.tick(cyan1=drive(20))
        deepest = max(deepest, pitch.depth())
    assert deepest < DEEP
    assert snapshot.ball.x > x
    assert pitch.at("cyan1").x < x
    (state,) = snapshot.obstacles
    assert (state.name, state.x, state.y, state.heading) == (obstacle.name, x, y, obstacle.heading)


def test_an_obstacle_reports_its_size_and_the_circle_around_it(pitch: WorldRig) -> None:
    for obstacle in (CRATE, POLE):
        pitch.world.put_obstacle(obstacle)
    crate, pole = pitch.world.snapshot().obstacles
    assert (crate.shape, crate.size_x, crate.size_y, crate.height) == (Shape.BOX, 0.4, 2.0, 0.5)
    assert crate.radius == approx(math.hypot(0.2, 1.0))
    assert (pole.shape, pole.size_x, pole.size_y, pole.radius, pole.height) == (Shape.CYLINDER, 0.3, 0.3, 0.15, 1.0)


def test_obstacles_are_put_moved_and_taken_away_between_two_ticks(pitch: WorldRig) -> None:
    def rebuilt(*obstacles: ObstacleConfig) -> None:
        pitch.world.rebuild_with(pitch.profile, pitch.roster, obstacles)

    pitch.place(cyan1=(-3, 2, 0))
    rebuilt(CRATE)
    pitch.run(2.0, cyan1=drive(3))
    assert pitch.at("cyan1").x < 1.0
    rebuilt(CRATE.model_copy(update={"place": [4.0, 2.0]}))
    pitch.place(cyan1=(1.0, 2, 0))
    pitch.run(1.5, cyan1=drive(3))
    at = pitch.at("cyan1").x
    assert 1.5 < at < 4.0
    assert len(pitch.world.snapshot().obstacles) == 1
    rebuilt()
    assert pitch.world.snapshot().obstacles == ()
    pitch.run(2.0, cyan1=drive(3))
    assert pitch.at("cyan1").x > at + 3.0


def test_the_last_touch_is_a_contact_and_a_near_ball_is_not_touched(pitch: WorldRig) -> None:
    """From contacts and possession, in the order of time."""
    pitch.place(cyan1=(0, 0, 0), magenta1=(2, 0, math.pi), ball=(-2, 0.245 + 0.11 + 0.01, 0))
    pitch.engine.set_ball_motion((4, 0, 0), (0, 4 / 0.11, 0))
    passing = [pitch.tick().touches for _ in range(40)]
    assert not any(passing)
    pitch.place(cyan1=(0, 0, 0), magenta1=(2, 0, math.pi), ball=(0.5, 0, 0))
    order = []
    for _ in range(60):
        snapshot = pitch.tick(cyan1=drive(3))
        order += [name for name in snapshot.touches if not order or name != order[-1]]
        assert snapshot.possession is None
    assert order[:2] == ["cyan1", "magenta1"]
    pitch.place(cyan1=(0, 0, 0), magenta1=(5, 0, 0), ball=(pitch.profile.dribble.gap, 0, 0))
    held = pitch.tick(cyan1=drive(dribble=True))
    assert (held.possession, held.touches) == ("cyan1", ("cyan1",))


def test_the_world_is_read_from_the_engine_after_every_tick(pitch: WorldRig) -> None:
    """The NuBot simulation takes states of models from a topic, a frame late."""
    snapshot = pitch.run(0.5, cyan1=drive(2, 1, 1))
    for body, state in zip(pitch.engine.robots, snapshot.robots, strict=True):
        (x, y, z), orientation = pybullet.getBasePositionAndOrientation(body, pitch.engine.client)
        heading = pybullet.getEulerFromQuaternion(orientation)[2]
        assert (x, y, z, heading) == approx((state.x, state.y, state.z, state.heading), abs=1e-12)
