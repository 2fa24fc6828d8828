"""Kicks against the paper's equations."""

import math

import pytest
from pytest import approx

from schemas.command import Kick, KickMode
from schemas.profile import load_profile
from sim_host.actuation.kick import (
    GRAVITY,
    KickRefusedError,
    distance_to_goal_plane,
    launch,
    lob_rise,
    solve_lob,
)

MSL = load_profile("msl")
PAPER = load_profile("paper")


def test_the_rise_of_a_lob_is_the_papers_h() -> None:
    """Equation 5 with the code's margin: 1.0 − 0.22 − 0.02 = 0.76 m."""
    assert lob_rise(PAPER.field, PAPER.ball.radius, PAPER.kicker.lob_margin) == approx(0.76)


@pytest.mark.parametrize("d", [0.5, 2.0, 5.0, 11.0, 20.0])
@pytest.mark.parametrize("speed", [2.0, 6.0, 20.0])
def test_the_solution_passes_through_d_and_h_and_stays_below_the_bound(d: float, speed: float) -> None:
    """Equations 8, 9 and 12, with a step that goes to zero: the parabola itself."""
    h = 0.76
    along, up = solve_lob(d, h, speed, step=0.0)
    t = d / along
    assert up * t - GRAVITY * t * t / 2 == approx(h)
    assert along < d * math.sqrt(GRAVITY / (2 * h))
    assert along == approx(min(speed, d * math.sqrt(GRAVITY / (2 * h)) / 2))
    assert up / GRAVITY * along < d, "the apex lies before the goal plane (equation 11)"


def test_a_ground_kick_leaves_along_the_kick_axis_at_its_speed() -> None:
    """Equation 3."""
    vx, vy, vz = launch(Kick(mode=KickMode.GROUND, speed=5), 0.0, 2.0, MSL.kicker, MSL)
    assert (math.hypot(vx, vy), math.atan2(vy, vx), vz) == approx((5.0, 2.0, 0.0))


def test_a_kick_is_no_faster_than_the_device() -> None:
    """Defect 12 of section 14: a lob's strength was not clamped."""
    ground = launch(Kick(mode=KickMode.GROUND, speed=40), 0.0, 0.0, MSL.kicker, MSL)
    lob = launch(Kick(mode=KickMode.LOB, speed=40), -10.0, 0.0, MSL.kicker, MSL)
    assert ground.vx == approx(MSL.kicker.max_ground_speed)
    assert lob.vx <= MSL.kicker.max_lob_speed


@pytest.mark.parametrize(("x", "heading", "d"), [(0, 0, 11), (3, math.pi, 14), (5, math.pi / 4, 6 * math.sqrt(2))])
def test_the_distance_is_measured_along_the_kick_axis_to_the_goal_line_ahead(
    x: float, heading: float, d: float
) -> None:
    assert distance_to_goal_plane(x, heading, MSL.field.goal_line) == approx(d)


def test_a_lob_that_meets_no_goal_line_is_refused_with_its_reason() -> None:
    with pytest.raises(KickRefusedError, match="aimed at a goal"):
        launch(Kick(mode=KickMode.LOB, speed=8), 0.0, math.pi / 2, MSL.kicker, MSL)
