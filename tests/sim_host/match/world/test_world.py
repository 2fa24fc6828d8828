"""The physical world against closed forms, for both profiles."""

import math
from collections.abc import Iterator
from dataclasses import replace

import pytest
from pytest import approx

from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive, Kick, KickMode
from sim_host.snapshot import BallState, RobotState, Roster, Snapshot
from support.world_rig import WorldRig

ROSTER = Roster.of(load_match(None, {"teams.cyan.size": 2, "teams.magenta.size": 2}), load_profile("msl"))
REST = AppliedInput(Drive(), dribble=False)
GRAVITY = 9.81


def robot(snapshot: Snapshot, name: str) -> RobotState:
    return snapshot.robots[ROSTER.names.index(name)]


@pytest.fixture(params=["msl", "paper"])
def rig(request: pytest.FixtureRequest) -> Iterator[WorldRig]:
    rig = WorldRig(load_profile(request.param))
    yield rig
    rig.world.close()


def drive(vx: float = 0.0, vy: float = 0.0, omega: float = 0.0, **more: object) -> AppliedInput:
    return AppliedInput(Drive(vx=vx, vy=vy, omega=omega), **{"dribble": False, **more})  # type: ignore[arg-type]


def test_the_loaded_bodies_have_the_profiles_mass_and_size(rig: WorldRig) -> None:
    """Read back from the engine."""
    import pybullet

    engine, robot_body = rig.engine, rig.profile.robot
    dynamics = pybullet.getDynamicsInfo(engine.robots[0], -1, physicsClientId=engine.client)
    assert dynamics[0] == robot_body.mass
    assert dynamics[2] == approx((robot_body.inertia_xx, robot_body.inertia_xx, robot_body.inertia_zz))
    ball = pybullet.getDynamicsInfo(engine.ball, -1, physicsClientId=engine.client)
    assert (ball[0], ball[2][0]) == approx((rig.profile.ball.mass, rig.profile.ball.inertia))


def test_a_robot_takes_v_over_a_to_its_speed_and_covers_half_v_t(rig: WorldRig) -> None:
    """v = 3 m/s: t = v/a within 2 %, distance v·t/2 within 2 %; on the body, not on a number."""
    rig.place(cyan1=(-5, 0, 0), ball=(0, 5, 0))
    a, ticks, snapshot = rig.profile.drive.acceleration, 0, rig.world.snapshot()
    while robot(snapshot, "cyan1").vx < 3 - 1e-6:
        snapshot = rig.tick(cyan1=drive(3))
        ticks += 1
    tick = rig.profile.time.tick
    assert ticks * tick == approx(3 / a, rel=0.02, abs=tick)
    assert robot(snapshot, "cyan1").x + 5 == approx(3 * 3 / a / 2, rel=0.02, abs=3 * tick)


def test_a_robot_turns_while_it_drives_straight_in_its_own_frame(rig: WorldRig) -> None:
    """Constant vx and omega: a circle of radius vx / omega."""
    rig.place(cyan1=(0, 0, 0), ball=(0, 5, 0))
    rig.run(2.0, cyan1=drive(1, omega=1))
    places = [robot(rig.tick(cyan1=drive(1, omega=1)), "cyan1") for _ in range(round(2 * math.pi / 0.02))]
    width = max(p.x for p in places) - min(p.x for p in places)
    assert width == approx(2.0, rel=0.02)
    assert all(math.hypot(p.vx, p.vy) == approx(1.0, rel=1e-3) for p in places)


def test_a_robot_let_go_of_stands_still_and_upright(rig: WorldRig) -> None:
    rig.place(cyan1=(0, 0, 0.3), ball=(0, 5, 0))
    rig.run(1.0, cyan1=drive(2, 1, 1))
    snapshot = rig.run(3.0)
    at = robot(snapshot, "cyan1")
    assert (at.vx, at.vy, at.omega) == approx((0, 0, 0), abs=1e-9)
    assert robot(snapshot, "cyan1").z == approx(rig.profile.robot.height / 2, abs=1e-3)


def held_ball(rig: WorldRig, x: float, y: float = 0.0, heading: float = 0.0) -> None:
    gap = rig.profile.dribble.gap
    rig.place(cyan1=(x, y, heading), ball=(x + gap * math.cos(heading), y + gap * math.sin(heading), 0))


@pytest.mark.parametrize(("y", "z"), [("post", 0.2), ("over", 1.6)])
def test_a_ball_on_the_post_or_over_the_bar_does_not_end_in_the_goal(rig: WorldRig, y: str, z: float) -> None:
    field, r = rig.profile.field, rig.profile.ball.radius
    at = field.goal_width / 2 + field.post / 2 if y == "post" else 0.0
    rig.engine.set_ball_state((field.goal_line - 0.6, at, z), (10, 0, 0), (0, 0, 0))
    for _ in range(100):
        ball = rig.tick().ball
        deep = field.goal_line + r < ball.x < field.goal_line + field.goal_depth
        inside = deep and abs(ball.y) < field.goal_width / 2 and ball.z < field.goal_height
        assert not inside


def test_a_ball_that_is_not_asked_for_is_not_held(rig: WorldRig) -> None:
    held_ball(rig, 0)
    assert rig.tick().possession is None
    assert rig.tick(cyan1=drive(dribble=True)).possession == "cyan1"
    assert rig.tick().possession is None


def test_a_kick_without_the_ball_is_refused_now_and_not_kept_for_later(rig: WorldRig) -> None:
    """In the NuBot simulation an accepted kick waits until the ball is held again."""
    rig.place(cyan1=(0, 0, 0), ball=(3, 0, 0))
    inputs = dict.fromkeys(ROSTER.names, REST)
    advance = rig.world.advance(inputs | {"cyan1": drive(kick=Kick(mode=KickMode.GROUND, speed=5))})
    assert advance.refused == {"cyan1": "kick: ball not held"}
    held_ball(rig, 0)
    snapshot = rig.run(0.2, cyan1=drive(dribble=True))
    assert snapshot.possession == "cyan1" and snapshot.ball.vx == approx(0, abs=0.01)


def test_two_robots_that_meet_do_not_pass_through_each_other(rig: WorldRig) -> None:
    rig.place(cyan1=(-2, 0, 0), magenta1=(2, 0, math.pi), ball=(0, 5, 0))
    for _ in range(round(3 / rig.profile.time.tick)):
        snapshot = rig.tick(cyan1=drive(2), magenta1=drive(2))
        apart = math.hypot(
            robot(snapshot, "cyan1").x - robot(snapshot, "magenta1").x,
            robot(snapshot, "cyan1").y - robot(snapshot, "magenta1").y,
        )
        assert apart > 2 * rig.profile.robot.radius - 0.02


def test_a_robot_that_is_held_back_is_stuck_and_only_that_one(rig: WorldRig) -> None:
    """Each robot has its own flag."""
    wall = rig.profile.field.goal_line + rig.profile.field.border - rig.profile.robot.radius
    rig.place(cyan1=(wall - 0.05, 3, 0), cyan2=(-3, 0, 0))
    told = dict.fromkeys(ROSTER.names, REST) | {"cyan1": drive(2), "cyan2": drive(2)}
    for _ in range(round(1 / rig.profile.time.tick)):
        advance = rig.world.advance(told)
    assert advance.stuck == [True, False, False, False]


def test_nothing_leaves_the_boundary(rig: WorldRig) -> None:
    field = rig.profile.field
    snapshot = rig.run(6.0, cyan1=drive(-20), magenta1=drive(20), magenta2=drive(20, -20))
    for state in snapshot.robots:
        assert abs(state.x) < field.goal_line + field.border and abs(state.y) < field.touch_line + field.border
    rig.place(ball=(0, 0, 0))
    rig.engine.set_ball_motion((9, 9, 4), (0, 0, 0))
    end = rig.run(8.0).ball
    assert abs(end.x) < field.goal_line + field.border and abs(end.y) < field.touch_line + field.border


def test_the_last_touch_of_the_ball_comes_from_contacts(rig: WorldRig) -> None:
    rig.place(cyan1=(0, 0, 0), ball=(1, 0, 0))
    touches: list[str] = []
    for _ in range(round(1 / rig.profile.time.tick)):
        touches += rig.tick(cyan1=drive(2)).touches
    assert touches and set(touches) == {"cyan1"}


def test_a_rebuilt_world_depends_on_the_poses_and_velocities_of_the_snapshot_alone() -> None:
    """A checkpoint: the same numbers put into a world with another past give the same future, to the last bit."""
    profile = load_profile("msl")
    chase = {"cyan1": drive(2, omega=0.3, dribble=True), "magenta1": drive(2, omega=-0.2, dribble=True)}
    live, other = WorldRig(profile), WorldRig(profile)
    live.place(cyan1=(-1.5, 0.1, 0), magenta1=(1.5, -0.1, math.pi), ball=(0, 0, 0))
    live.run(1.0, **chase)
    other.run(0.5, cyan1=drive(3, 1, 1))
    live.copy_to(other)
    for _ in range(75):
        live.tick(**chase)
        other.tick(**chase)
        assert live.engine.packed() == other.engine.packed()


def test_a_turned_world_with_the_same_commands_is_the_turned_world() -> None:
    """Turned by π, cyan for magenta, everything happens as before, to 1 mm after two seconds of play."""
    profile = load_profile("msl")
    one, other = WorldRig(profile), WorldRig(profile)
    one.place(cyan1=(-1.0, 0.2, 0.1), magenta1=(3.0, -1.0, 2.0), ball=(-0.65, 0.235, 0))
    other.place(magenta1=(1.0, -0.2, 0.1 - math.pi), cyan1=(-3.0, 1.0, 2.0 - math.pi), ball=(0.65, -0.235, 0))
    kick = drive(1, 0.2, 0.5, kick=Kick(mode=KickMode.GROUND, speed=4))
    for tick in range(100):
        mine = kick if tick == 40 else drive(1, 0.2, 0.5, dribble=True)
        a = one.tick(cyan1=mine, magenta1=drive(1.5))
        b = other.tick(magenta1=mine, cyan1=drive(1.5))
    assert (b.ball.x, b.ball.y) == approx((-a.ball.x, -a.ball.y), abs=1e-3)
    assert (robot(b, "magenta1").x, robot(b, "magenta1").y) == approx(
        (-robot(a, "cyan1").x, -robot(a, "cyan1").y), abs=1e-3
    )


def test_the_hash_chain_tells_any_difference_of_any_tick() -> None:
    profile = load_profile("msl")
    chains = []
    for vx in (1.0, 1.0, 1.0 + 1e-9):
        rig = WorldRig(profile)
        chain = []
        for tick in range(40):
            rig.tick(cyan1=drive(vx if tick == 30 else 1.0))
            chain.append(rig.world.chain())
        chains.append(chain)
        rig.world.close()
    assert chains[0] == chains[1]
    assert chains[0][:30] == chains[2][:30] and chains[0][30] != chains[2][30]


def test_a_heavier_ball_or_another_size_is_a_matter_of_the_profile() -> None:
    profile = load_profile("msl")
    slow = replace(profile, ball=replace(profile.ball, rolling_deceleration=2.0))
    ends = []
    for one in (profile, slow):
        rig = WorldRig(one)
        rig.engine.set_ball_motion((2, 0, 0), (0, 2 / one.ball.radius, 0))
        ends.append(rig.run(5.0).ball.x)
        rig.world.close()
    assert ends[0] > 2 * ends[1]
    assert isinstance(rig.world.snapshot().ball, BallState)


@pytest.mark.parametrize(("apart", "touch"), [(0.01, True), (0.2, False)])
def test_the_snapshot_has_the_pairs_of_robots_that_touch(rig: WorldRig, apart: float, touch: bool) -> None:
    """Pairs of places in the roster, the first one first; a robot that presses against another touches it."""
    away = rig.profile.robot.radius + 0.5 * apart
    rig.place(cyan2=(away, 0, math.pi), magenta1=(-away, 0, 0), ball=(0, 4, 0))
    told = {"cyan2": drive(vx=0.3 * touch), "magenta1": drive(vx=0.3 * touch)}
    assert rig.run(0.5, **told).contacts == (((1, 2),) if touch else ())


def test_the_snapshot_has_the_spin_of_a_ball_that_rolls(rig: WorldRig) -> None:
    """A ball that rolls turns at its speed over its radius, about the axis to the left of its way."""
    radius = rig.profile.ball.radius
    rig.engine.set_ball_motion((1.2, 0.5, 0.0), (-0.5 / radius, 1.2 / radius, 0.0))
    snapshot = rig.tick()
    ball = snapshot.ball
    assert snapshot.ball_spin == approx((-ball.vy / radius, ball.vx / radius), rel=0.02)
