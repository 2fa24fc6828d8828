"""The closed forms of a rolling ball against a reference integration in steps of 1 ms."""

import pytest
from pytest import approx

from schemas.config.rolling import Rolling

KINDS = [Rolling(0.5), Rolling(0.5, 0.0145), Rolling(2.94, 0.1), Rolling(0.0, 0.02), Rolling(0.0)]


def integrated(rolling: Rolling, speed: float, time: float) -> tuple[float, float]:
    distance, step = 0.0, 1e-3
    for _ in range(round(time / step)):
        middle = max(0.0, speed - step / 2 * (rolling.deceleration + rolling.drag * speed**2))
        speed = max(0.0, speed - step * (rolling.deceleration + rolling.drag * middle**2))
        distance += step * middle
    return speed, distance


@pytest.mark.parametrize("rolling", KINDS)
@pytest.mark.parametrize("speed", [0.3, 2.0, 10.0])
@pytest.mark.parametrize("time", [0.1, 1.5, 30.0])
def test_speed_and_distance_are_those_of_the_equation_of_motion(rolling: Rolling, speed: float, time: float) -> None:
    left, distance = integrated(rolling, speed, time)
    assert rolling.after(speed, time) == (approx(left, abs=1e-3), approx(distance, abs=2e-3))


@pytest.mark.parametrize("rolling", KINDS)
@pytest.mark.parametrize("arriving", [0.5, 3.0])
def test_a_ball_sent_with_the_speed_to_arrive_arrives_with_it(rolling: Rolling, arriving: float) -> None:
    speed = rolling.speed_to_arrive(arriving, 6.0)
    before, after = 0.0, 60.0
    for _ in range(60):
        middle = (before + after) / 2
        before, after = (middle, after) if rolling.after(speed, middle)[1] < 6.0 else (before, middle)
    assert rolling.after(speed, after)[0] == approx(arriving, abs=1e-6)


@pytest.mark.parametrize("rolling", KINDS)
def test_a_ball_at_rest_stays_there(rolling: Rolling) -> None:
    assert rolling.after(0.0, 5.0) == (0.0, 0.0)
