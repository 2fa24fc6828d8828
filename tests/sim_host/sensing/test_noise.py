"""The noise of what robots perceive: mean, sigma, rate, whiteness, independence; and how slowly drift wanders.

Estimates of n independent draws are within 4 standard errors of what they estimate: 4σ/√n for a mean, 4σ/√(2n) for a
standard deviation, 4/√n for a correlation.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from pytest import approx

from schemas.config.noise import PERFECT, SIMATCH, sensing_of
from schemas.config.profile import load_profile

N = 4000
ME, BALL, OTHER = (0.0, 0.0, 0.7), (3.0, 4.0, 0.3, 1.0, 2.0), (-3.0, 0.0)
TRUE = {"own": [0.0, 0.0, 0.7, 0.0, 0.0, 0.0], "ball": list(BALL), "obstacle": [-3.0, 0.0]}
SIGMA = 0.05

COLUMNS = {
    "own_position": [("own", 0), ("own", 1)],
    "own_heading": [("own", 2)],
    "own_velocity": [("own", 3), ("own", 4)],
    "own_turn_rate": [("own", 5)],
    "ball_position": [("ball", 0), ("ball", 1), ("ball", 2)],
    "ball_velocity": [("ball", 3), ("ball", 4)],
    "obstacle_position": [("obstacle", 0), ("obstacle", 1)],
}
"""Parameter → the numbers whose noise it is."""


@pytest.fixture
def errors(scenery):
    """What `ticks` percepts of the first robot say beside the truth, by column."""

    def measure(ticks=N, robots=(ME, OTHER), ball=BALL, **sensing):
        made = scenery(robots, ball, **sensing)
        looks = [made.look() for _ in range(ticks)]

        def of(place):
            seen = [look[place] for look in looks]
            obstacles = [min(one.obstacles, key=lambda row: abs(row[0]) + abs(row[1]))[:2] for one in seen]
            rows = {"own": [one.own for one in seen], "ball": [one.ball for one in seen], "obstacle": obstacles}
            return {(kind, i): np.array(row)[:, i] for kind, row in rows.items() for i in range(len(TRUE[kind]))}

        return of

    return measure


@pytest.mark.parametrize("name", COLUMNS)
def test_each_noise_has_the_mean_and_sigma_it_is_given_and_is_white(errors, name):
    """No other number is touched."""
    for key, values in errors(**{name: SIGMA})(0).items():
        error = values - TRUE[key[0]][key[1]]
        if key not in COLUMNS[name]:
            assert np.abs(error).max() < 1e-12
            continue
        assert error.mean() == approx(0, abs=4 * SIGMA / math.sqrt(N))
        assert error.std() == approx(SIGMA, abs=4 * SIGMA / math.sqrt(2 * N))
        assert np.corrcoef(error[1:], error[:-1])[0, 1] == approx(0, abs=4 / math.sqrt(N))
        assert (error**4).mean() / error.var() ** 2 == approx(3, abs=4 * math.sqrt(24 / N)), "Gaussian"


def test_noises_of_different_numbers_robots_and_things_are_independent(errors):
    of = errors(**dict.fromkeys(COLUMNS, SIGMA))
    series = [values for place in (0, 1) for values in of(place).values()]
    matrix = np.corrcoef(series) - np.eye(len(series))
    assert np.abs(matrix).max() < 4.5 / math.sqrt(N)


@pytest.mark.parametrize(("distance", "where"), [(1.0, (1.0, 0.0)), (5.0, (3.0, 4.0)), (6.0, (0.0, -6.0))])
def test_noise_grows_with_the_distance_along_and_across_the_line_of_sight(errors, distance, where):
    """√(near² + (share·d)²) along, √(near² + (angle·d)²) across, as in `schemas.config.sections.Sensing`."""
    of = errors(ball=(*where, 0.11), ball_position=0.02, range_noise=0.03, bearing_noise=0.01)(0)
    error = np.stack((of["ball", 0] - where[0], of["ball", 1] - where[1]))
    ux, uy = where[0] / distance, where[1] / distance
    along, across = ux * error[0] + uy * error[1], ux * error[1] - uy * error[0]
    assert along.std() == approx(math.hypot(0.02, 0.03 * distance), rel=4 / math.sqrt(2 * N))
    assert across.std() == approx(math.hypot(0.02, 0.01 * distance), rel=4 / math.sqrt(2 * N))


def test_noise_of_the_balls_velocity_grows_with_its_distance(errors):
    of = errors(ball_velocity=0.1, ball_velocity_growth=0.05)(0)
    assert of["ball", 3].std() == approx(math.hypot(0.1, 0.05 * 5.0), rel=4 / math.sqrt(2 * N))


def test_the_papers_noise_is_a_preset(errors):
    """The paper's code: sigma 0.0194 on positions, velocities and yaw rate, none on the heading; no limits at all."""
    paper = sensing_of("paper", load_profile("msl").sensing)
    assert paper == load_profile("paper").sensing
    of = errors(sensing=paper)(0)
    for key, values in of.items():
        sigma = 0.0 if key == ("own", 2) else 0.0194
        assert values.std() == approx(sigma, rel=4 / math.sqrt(2 * N), abs=1e-12)
    names = ("ball_range", "ball_dropout", "occlusion", "latency", "drift_position")
    assert replace(paper, **{name: getattr(PERFECT, name) for name in names}) == paper


def test_one_reading_in_a_hundred_is_noisy_with_simatchs_noise(errors):
    """A rate of 0.01 is 1 in 100 (1 in 11 in simatch), within 4 standard errors of 10,000.

    Sigma of the noisy readings is 0.10; x, y, vx and vy of one reading are noisy together, the heading never.
    """
    n = 10_000
    of = errors(n, sensing=sensing_of("simatch", PERFECT))(0)
    for kind, columns in {"own": (0, 1, 3, 4), "ball": (0, 1, 3, 4), "obstacle": (0, 1)}.items():
        error = np.stack([of[kind, i] - TRUE[kind][i] for i in columns])
        differs = np.abs(error) > 1e-9
        noisy = differs.any(axis=0)
        assert differs[:, noisy].mean() > 0.99, "together, but for noise below 0.1 mm"
        assert noisy.mean() == approx(0.01, abs=4 * math.sqrt(0.01 * 0.99 / n))
        chosen = error[:, noisy]
        assert chosen.std() == approx(0.10, rel=4 / math.sqrt(2 * chosen.size))
        gaps = np.diff(np.flatnonzero(noisy))
        assert gaps.mean() == approx(100, abs=4 * 100 / math.sqrt(len(gaps))), "as rare at any time"
    assert np.ptp(of["own", 2]) < 1e-12 and np.ptp(of["own", 5]) == 0.0
    assert SIMATCH.noise_rate == 0.01


DRIFT = {"drift_position": 0.05, "drift_heading": 0.01, "drift_time": 1.0}


def test_drift_has_its_configured_size_at_any_time_and_is_slow_and_each_robots_own(errors):
    """8,000 ticks are 160 drift times; 4 standard errors of about as many independent values.

    Per tick it changes by at most |d/dt (k₀ cos + k₁ sin)| = π/2 · |k| / drift time, |k| below 5 sigma.
    """
    n = 8_000
    drifted = errors(n, **DRIFT)
    of, other = drifted(0), drifted(1)
    independent = n * 0.02 / DRIFT["drift_time"]
    for key, sigma in ((("own", 0), 0.05), (("own", 1), 0.05), (("own", 2), 0.01)):
        drift = of[key] - TRUE["own"][key[1]]
        assert np.corrcoef(of[key], other[key])[0, 1] == approx(0, abs=4 / math.sqrt(independent))
        assert drift.std() == approx(sigma, rel=4 / math.sqrt(2 * independent))
        assert drift.mean() == approx(0, abs=4 * sigma / math.sqrt(independent))
        assert np.abs(np.diff(drift)).max() < math.pi / 2 * 5 * sigma * math.sqrt(2) * 0.02 / DRIFT["drift_time"]
        halves = drift.reshape(-1, 50)  # 50 ticks from knot to knot
        assert halves[:, 25].std() == approx(sigma, rel=4 / math.sqrt(2 * independent)), "between knots as at them"


def test_drift_moves_everything_a_robot_sees_as_it_moves_itself(scenery):
    """From the robot's own point of view, distance and bearing stay true."""
    made = scenery((ME, OTHER), BALL, **DRIFT)
    for _ in range(300):
        one = made.look()[0]
        x, y, heading = one.own[:3]
        bearing = math.atan2(one.ball[1] - y, one.ball[0] - x) - heading
        assert math.hypot(one.ball[0] - x, one.ball[1] - y) == approx(5.0, abs=2e-4)
        assert math.remainder(bearing - (math.atan2(4.0, 3.0) - 0.7), math.tau) == approx(0, abs=2e-4)
        assert math.hypot(one.ball[3], one.ball[4]) == approx(math.hypot(1.0, 2.0), abs=2e-4)
        assert math.dist(one.obstacles[0][:2], (x, y)) == approx(3.0, abs=2e-4)


def test_drift_is_drawn_for_its_time_alone(scenery):
    """Nothing is remembered: a perception that begins late drifts as one that has run all the time."""
    early, late = scenery((ME, OTHER), BALL, **DRIFT), scenery((ME, OTHER), BALL, **DRIFT)
    for _ in range(500):
        expected = early.look()
    late.tick = 499
    assert late.look() == expected
