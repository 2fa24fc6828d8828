"""The closed forms of a ball that slides and then rolls, against a reference integration in steps of 0.5 ms."""

import math
from dataclasses import replace

import pytest
from pytest import approx

from schemas.config.profile import load_profile
from schemas.config.rolling import Rolling
from schemas.config.soccer.kicked import Kicked

MSL = load_profile("msl")
INERTIA = MSL.ball.inertia / MSL.ball.mass / MSL.ball.radius**2


def kicked(spin=0.0, **ball):
    return Kicked.of(replace(MSL.ball, **ball), replace(MSL.kicker, kick_spin=spin))


KINDS = [kicked(), kicked(0.5), kicked(1.0), kicked(air_density=0.0), kicked(friction=0.0), kicked(friction=0.1)]


def integrated(kind, speed, time, step=5e-4):
    """Speed and distance, from the forces alone."""
    rim, distance = kind.spin * speed, 0.0
    for _ in range(round(time / step)):
        if speed - rim > 1e-9 and kind.sliding.deceleration > 0.0:
            slower = speed - step * (kind.sliding.deceleration + kind.sliding.drag * speed**2)
            rim += step * kind.sliding.deceleration / kind.inertia
            slower = max(slower, min(rim, speed))
        elif speed - rim > 1e-9:
            slower = speed - step * kind.sliding.drag * speed**2
        else:
            slower = max(0.0, speed - step * (kind.rolling.deceleration + kind.rolling.drag * speed**2))
            rim = slower
        distance += step * (speed + slower) / 2
        speed = slower
    return speed, distance


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("speed", [0.5, 4.0, 10.0])
@pytest.mark.parametrize("time", [0.05, 0.3, 2.0, 20.0])
def test_speed_and_distance_are_those_of_the_equation_of_motion(kind, speed, time):
    left, distance = integrated(kind, speed, time)
    assert kind.after(speed, time) == (approx(left, abs=0.01), approx(distance, abs=0.02))


def test_without_air_a_ball_that_slid_rolls_at_its_share_of_the_speed():
    """1 / (1 + I/(m·r²)) for a kick without spin, 0.61 of this ball; after v·k / ((1 + k)·μ·g)."""
    kind = kicked(air_density=0.0)
    assert kind.slide(8.0) == approx(8.0 * INERTIA / (1 + INERTIA) / (MSL.ball.friction * 9.81))
    assert kind.after(8.0, kind.slide(8.0))[0] == approx(8.0 / (1 + INERTIA))


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind.sliding.deceleration])
@pytest.mark.parametrize("arriving", [0.0, 0.5, 3.5])
@pytest.mark.parametrize("distance", [0.3, 2.0, 5.0, 9.0])
def test_a_kick_with_the_speed_to_arrive_arrives_with_it(kind, arriving, distance):
    speed = kind.speed_to_arrive(arriving, distance)
    before, after = 0.0, 200.0
    for _ in range(80):
        middle = (before + after) / 2
        before, after = (middle, after) if kind.after(speed, middle)[1] < distance - 1e-9 else (before, middle)
    left, way = kind.after(speed, after)
    assert way == approx(distance, abs=1e-3)
    assert left == approx(arriving, abs=0.05 if arriving == 0.0 else 1e-4)


def test_on_ice_the_air_alone_slows_a_kick():
    """A ball without friction never rolls."""
    kind = kicked(friction=0.0)
    assert kind.slide(5.0) == math.inf
    assert kind.speed_to_arrive(3.5, 6.0) == approx(3.5 * math.exp(kind.sliding.drag * 6.0))


def test_a_kick_with_the_spin_of_rolling_is_that_of_a_rolling_ball():
    """As in recordings that do not name `kick_spin`."""
    kind, rolling = kicked(1.0), Rolling.of(MSL.ball)
    assert kind.after(5.0, 1.3) == rolling.after(5.0, 1.3)
    assert kind.speed_to_arrive(2.0, 4.0) == rolling.speed_to_arrive(2.0, 4.0)
