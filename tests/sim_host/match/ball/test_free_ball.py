"""The free ball against closed forms and a reference integration: it slides, rolls, flies, bounces and rests."""

import math
from itertools import pairwise

import pytest
from pytest import approx

from sim_host.physics.bounce import bounce

G = 9.81
NO_AIR = {"drag_coefficient": 0.0, "rolling_drag_coefficient": 0.0}
STILL = NO_AIR | {"rolling_deceleration": 0.0}


@pytest.mark.parametrize("speed", [0.5, 2.0, 4.0])
def test_without_air_a_rolling_ball_stops_after_v_squared_over_two_a(rig, build, speed):
    """The profile's rolling deceleration, within 2 % and 1 cm; then it rests for good."""
    rig = build(rig.profile.name, ball=NO_AIR)
    ball, r = rig.profile.ball, rig.profile.ball.radius
    rig.set_ball((-8, 0, r), (speed, 0, 0), (0, speed / r, 0))
    end = rig.run(speed / ball.rolling_deceleration + 0.5).ball
    assert end.x + 8 == approx(speed**2 / 2 / ball.rolling_deceleration, rel=0.02, abs=0.01)
    after = rig.run(3.0).ball
    assert after[:2] == approx(end[:2], abs=1e-9) and math.hypot(*after[3:]) < 1e-3


@pytest.mark.parametrize("speed", [4.0, 10.0])
def test_a_rolling_ball_feels_the_ground_and_the_air(build, speed):
    """dv/dt = -(a + k·v²): after 15 m v² = (v₀² + a/k)·exp(-2·k·15) - a/k, within 1 %, and it stops where it should.

    k = ½·ρ·c·π·r² / (m + I/r²), since a rolling ball turns, too. From 10 m/s it has 7.25 m/s left; without air, 9.2.
    """
    rig = build("msl")
    ball, r = rig.profile.ball, rig.profile.ball.radius
    k = 0.5 * ball.air_density * ball.rolling_drag_coefficient * math.pi * r**2 / (ball.mass + ball.inertia / r**2)
    scale = ball.rolling_deceleration / k
    rig.set_ball((-10.5, 0, r), (speed, 0, 0), (0, speed / r, 0))
    stop = math.log(1 + speed**2 / scale) / (2 * k)
    if stop < 15.0:
        assert rig.run(8.0).ball.x + 10.5 == approx(stop, rel=0.01)
        return
    now = rig.tick().ball
    while now.x < 4.5:
        before, now = now, rig.tick().ball
    share = (4.5 - before.x) / (now.x - before.x)
    left = before.vx + share * (now.vx - before.vx)
    assert left == approx(math.sqrt((speed**2 + scale) * math.exp(-2 * k * 15) - scale), rel=0.01)
    assert left == approx(7.25, abs=0.1)


@pytest.mark.parametrize("shape", [2 / 5, 2 / 3])
@pytest.mark.parametrize("speed", [1.0, 4.0])
def test_a_sliding_ball_rolls_at_5_7_of_its_speed_if_it_is_solid_and_at_3_5_if_it_is_a_shell(build, shape, speed):
    """v' = v / (1 + I / (m·r²)), within 1 %: angular momentum about the point of contact is kept."""
    ball = build().profile.ball
    rig = build(ball=STILL | {"inertia": shape * ball.mass * ball.radius**2})
    rig.set_ball((-5, 0, ball.radius), (speed, 0, 0))
    end = rig.run(1.5).ball
    assert end.vx == approx(speed / (1 + shape), rel=0.01)
    assert rig.engine.ball_now().spin[1] == approx(end.vx / ball.radius, rel=0.01)


def test_a_ball_that_spins_on_the_spot_begins_to_roll(build):
    """The other way round: from ω·r without speed to ω·r·(I / m·r²) / (1 + I / m·r²), within 1 %."""
    rig = build(ball=STILL)
    ball = rig.profile.ball
    k = ball.inertia / ball.mass / ball.radius**2
    rig.set_ball((0, 0, ball.radius), (0, 0, 0), (0, 20.0, 0))
    assert rig.run(1.0).ball.vx == approx(20.0 * ball.radius * k / (1 + k), rel=0.01)


@pytest.mark.parametrize("height", [0.3, 0.7, 1.0, 1.05, 2.0])
def test_a_dropped_ball_bounces_to_e_squared_of_its_height(rig, build, height):
    """h' = e²·h within 1 % and 5 mm, whatever phase of a step the impact falls into; drag off."""
    rig = build(rig.profile.name, ball={"drag_coefficient": 0.0})
    ball = rig.profile.ball
    rig.set_ball((0, 0, ball.radius + height))
    heights = [rig.tick().ball for _ in range(round(2.0 / rig.profile.time.tick))]
    first = next(place for place, now in enumerate(heights) if now.vz > 0)
    top = next(after.z for before, after in pairwise(heights[first:]) if after.vz <= 0)
    assert top - ball.radius == approx(ball.restitution**2 * height, rel=0.01, abs=0.005)


def test_a_bouncing_ball_comes_to_rest_on_the_ground(rig):
    rig.set_ball((0, 0, rig.profile.ball.radius + 1.0), (1, 0.5, 0), (3, 2, 1))
    rig.run(10.0)
    before, after = rig.tick().ball, rig.run(1.0).ball
    assert after == approx(before, abs=1e-4)
    assert after.z == approx(rig.profile.ball.radius, abs=1e-3)


@pytest.mark.parametrize(("height", "bounces"), [(0.0101, True), (0.0104, False), (0.02, False)])
def test_a_ball_bounces_in_the_step_in_which_it_reaches_the_ground_and_not_earlier(build, height, bounces):
    """At 2 m/s it falls 10.2 mm in a step of 5 ms."""
    assert (bounce(build().profile.ball, height, (0, 0, -2.0), (0, 0, 0), 0.005) is not None) is bounces


def test_a_slide_becomes_spin_at_the_bounce_as_far_as_friction_reaches(build):
    """Textbook: Δv = min(μ·(1 + e)·v_n, slide / (1 + m·r²/I)) against the slide."""
    ball = build().profile.ball
    turning = ball.mass * ball.radius**2 / ball.inertia
    for speed in (1.0, 9.0):
        velocity, spin = bounce(ball, 0.0, (speed, 0, -2.0), (0, 0, 0), 1e-6)
        loss = min(ball.friction * (1 + ball.restitution) * 2.0, speed / (1 + turning))
        assert velocity[:2] == approx((speed - loss, 0), rel=1e-4)
        assert spin == approx((0, turning * loss / ball.radius, 0), rel=1e-4)
        assert velocity[2] == approx(ball.restitution * 2.0, rel=1e-3)
    velocity, spin = bounce(ball, 0.0, (1.0, 0, -2.0), (0, 1.0 / ball.radius, 0), 0.005)
    assert (velocity[0], spin[1]) == approx((1.0, 1.0 / ball.radius)), "a ball that rolls is not rubbed"


def reference_flight(ball, position, velocity, spin, seconds):
    """Runge-Kutta of fourth order, 0.1 ms a step: gravity, ½·ρ·c·A·v² of drag, and Magnus force across spin and way."""
    share = 0.5 * ball.air_density * math.pi * ball.radius**2 / ball.mass

    def change(state):
        v, w = state[3:], spin
        size = math.hypot(*v)
        across = (w[1] * v[2] - w[2] * v[1], w[2] * v[0] - w[0] * v[2], w[0] * v[1] - w[1] * v[0])
        pull = [
            -share * ball.drag_coefficient * size * v[i] + share * ball.magnus_coefficient * ball.radius * across[i]
            for i in range(3)
        ]
        return [*v, pull[0], pull[1], pull[2] - G]

    state, dt = [*position, *velocity], 1e-4
    for _ in range(round(seconds / dt)):
        k1 = change(state)
        k2 = change([s + dt / 2 * k for s, k in zip(state, k1, strict=True)])
        k3 = change([s + dt / 2 * k for s, k in zip(state, k2, strict=True)])
        k4 = change([s + dt * k for s, k in zip(state, k3, strict=True)])
        state = [s + dt / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip(state, k1, k2, k3, k4, strict=True)]
    return state


@pytest.mark.parametrize("velocity", [(4.0, 0.0, 3.0), (9.0, -2.0, 4.0), (12.0, 1.0, 5.0)])
@pytest.mark.parametrize("spin", [(0.0, 0.0, 0.0), (0.0, 0.0, 40.0), (10.0, -50.0, 5.0)])
def test_a_ball_in_flight_follows_drag_and_magnus_force(build, velocity, spin):
    """Within 1 cm and 2 cm/s of the reference after 0.5 s, less the ½·g·dt·t that the engine's sum falls deeper."""
    rig = build()
    assert rig.profile.ball.drag_coefficient > 0.0 and rig.profile.ball.magnus_coefficient > 0.0
    rig.set_ball((-6, 0, 1.0), velocity, spin)
    end = rig.run(0.5).ball
    want = reference_flight(rig.profile.ball, (-6, 0, 1.0), velocity, spin, 0.5)
    want[2] -= G * rig.profile.time.physics_step * 0.5 / 2
    assert end[:3] == approx(want[:3], abs=0.01)
    assert end[3:] == approx(want[3:], abs=0.02)


def test_the_papers_ball_flies_a_parabola(build):
    """Section III B 3 and equations 4 to 8: without air, within 1 mm of the engine's sum, z = v·t − g·t·(t + dt)/2."""
    rig = build("paper")
    rig.set_ball((-3, 0, 0.6), (4, 1, 3))
    for tick in range(1, round(0.6 / rig.profile.time.tick)):
        ball, t = rig.tick().ball, tick * rig.profile.time.tick
        drop = G * t * (t + rig.profile.time.physics_step) / 2
        assert ball[:3] == approx((-3 + 4 * t, t, 0.6 + 3 * t - drop), abs=1e-3)


@pytest.mark.parametrize("velocity", [(5, 0, 0), (8, 1, 0), (6, 0, 3)])
def test_a_ball_in_the_goal_rests_there(rig, velocity):
    field, r = rig.profile.field, rig.profile.ball.radius
    rig.set_ball((field.goal_line - 1, 0.3, r), velocity)
    end = rig.run(8.0).ball
    assert field.goal_line + r < end.x < field.goal_line + field.goal_depth
    assert rig.run(2.0).ball == approx(end, abs=1e-4)


@pytest.mark.parametrize("wall", ["side", "other side", "back", "roof"])
@pytest.mark.parametrize("sign", [1, -1])
def test_the_net_keeps_a_ball_outside_that_does_not_come_through_the_front(rig, wall, sign):
    field, r = rig.profile.field, rig.profile.ball.radius
    middle, width, depth = field.goal_line + field.goal_depth / 2, field.goal_width / 2, field.goal_depth
    position, velocity = {
        "side": ((middle, width + 0.6, r), (0, -4, 0)),
        "other side": ((middle, -width - 0.6, r), (0, 4, 0)),
        "back": ((field.goal_line + depth + 0.4, 0, r), (-4, 0, 0)),
        "roof": ((middle, 0, field.goal_height + 0.8), (0, 0, -2)),
    }[wall]
    rig.set_ball((sign * position[0], position[1], position[2]), (sign * velocity[0], velocity[1], velocity[2]))
    for _ in range(50):
        ball = rig.tick().ball
        is_inside = field.goal_line < sign * ball.x < field.goal_line + depth and abs(ball.y) < width
        assert not is_inside or ball.z > field.goal_height


@pytest.mark.parametrize("velocity", [(0, 5, 0), (0, -5, 0), (0, 0, 5), (5, 0, 0)])
def test_the_net_keeps_a_ball_in_the_goal(rig, velocity):
    field, r = rig.profile.field, rig.profile.ball.radius
    rig.set_ball((field.goal_line + field.goal_depth / 2, 0.0, 2 * r), velocity)
    for _ in range(50):
        ball = rig.tick().ball
        assert abs(ball.y) < field.goal_width / 2 and ball.z < field.goal_height
        assert ball.x < field.goal_line + field.goal_depth


def test_a_checkpoint_lets_a_rolling_ball_roll_on(build):
    """Spin is not part of a snapshot: a ball on the ground is given that of rolling, and does not slide again."""
    rig = build(ball=STILL)
    r = rig.profile.ball.radius
    rig.set_ball((-3, 0, r), (2, 0, 0), (0, 2 / r, 0))
    rig.run(0.5)
    rig.world.make_checkpoint()
    assert rig.run(0.5).ball.vx == approx(2.0, rel=1e-3)
