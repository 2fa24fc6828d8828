"""Kicks against the paper's equations, and lobs against the flight they are solved for."""

import math
from contextlib import nullcontext
from dataclasses import replace

import pytest
from pytest import approx

from schemas.config.profile import Profile, load_profile
from schemas.config.rolling import GRAVITY
from schemas.messages.command import KickMode
from sim_host.snapshot import BallState
from sim_host.soccer.ball.aerodynamics import Aerodynamics
from sim_host.soccer.ball.kick import KickRefusedError, Launch, PlannedKick, launch
from sim_host.soccer.ball.lob import Aim, distance_to_goal_plane, fly, parabola, solve

MSL = load_profile("msl")
PAPER = load_profile("paper")
DRAG = Aerodynamics.of_ball(MSL.ball).drag


def kicked(mode: KickMode, speed: float, profile: Profile = MSL, x: float = 0.0, heading: float = 0.0) -> Launch:
    """A kick of a ball on the ground at (x, 0)."""
    ball = BallState(x, 0.0, profile.ball.radius, 0.0, 0.0, 0.0)
    return launch(mode, PlannedKick(speed, ball, heading, profile.kicker, profile))


def aim(profile: Profile = MSL) -> Aim:
    r = profile.ball.radius
    return Aim(profile.field.goal_height, r + profile.kicker.lob_margin, r)


def test_the_rise_of_a_lob_is_the_papers_h() -> None:
    """Equation 5 with the code's margin: 1.0 − 0.22 − 0.02 = 0.76 m."""
    assert aim(PAPER).rise() == approx(0.76)


def test_a_ball_that_is_kicked_from_higher_up_rises_less() -> None:
    assert aim()._replace(start=0.3).rise() == approx(1.0 - 0.3 - 0.13)
    assert aim()._replace(start=0.3).rise(steepness=20.0) == 0.0


@pytest.mark.parametrize("d", [0.5, 2.0, 5.0, 11.0, 20.0])
@pytest.mark.parametrize("speed", [2.0, 6.0, 20.0])
def test_the_parabola_passes_through_d_and_h_and_stays_below_the_bound(d: float, speed: float) -> None:
    """Equations 8, 9 and 12, with a step that goes to zero."""
    h = 0.76
    along, up = parabola(d, h, speed, step=0.0)
    t = d / along
    assert up * t - GRAVITY * t * t / 2 == approx(h)
    assert along < d * math.sqrt(GRAVITY / (2 * h))
    down = GRAVITY * t - up
    assert along == approx(min(speed, d * math.sqrt(GRAVITY / (2 * h)) / 2)) or down / along == approx(1.2)
    assert up / GRAVITY * along < d, "the apex lies before the goal plane (equation 11)"


@pytest.mark.parametrize("d", [0.5, 2.0, 5.0, 11.0, 16.0])
@pytest.mark.parametrize("speed", [2.0, 6.0, 9.0, 12.0])
@pytest.mark.parametrize("drag", [0.0, DRAG, 2 * DRAG])
def test_a_solved_lob_arrives_at_its_point_with_and_without_drag(d: float, speed: float, drag: float) -> None:
    """Within 1 mm of the aim in the engine's own steps, and within a ball's radius of the paper's (d, h).

    Below the bound of equation 12 and past the apex (equation 11).
    """
    speeds = solve(d, aim(), speed, 40.0, drag, MSL.time.physics_step)
    assert speeds is not None
    along, up = speeds
    flight = fly(along, up, d, drag, MSL.time.physics_step)
    assert flight is not None
    assert flight.rise == approx(aim().rise(flight.steepness), abs=1e-3)
    assert abs(flight.rise - aim().rise()) < MSL.ball.radius
    assert along < d * math.sqrt(GRAVITY / (2 * aim().rise()))
    before = fly(along, up, 0.98 * d, drag, MSL.time.physics_step)
    assert before is not None and before.rise > flight.rise, "the ball comes down through the goal plane"


def test_a_lob_that_the_air_stops_is_not_solved() -> None:
    """In air twenty times as thick a ball never flies 20 m: more speed upward does not help, drag grows with it."""
    assert solve(20.0, aim(), 8.0, 12.0, 20 * DRAG, MSL.time.physics_step) is None


def test_a_long_lob_at_the_devices_top_speed_comes_down_steeply_and_clears_the_bar_all_the_same() -> None:
    """From goal to goal: 12 m/s along the ground is all there is, and h is lowered by more than a ball's radius."""
    vx, _, vz = kicked(KickMode.LOB, 8.0, x=-11.0)
    flight = fly(vx, vz, 22.0, DRAG, MSL.time.physics_step)
    assert vx == approx(MSL.kicker.max_lob_speed)
    assert flight is not None and flight.rise == approx(aim().rise(flight.steepness), abs=1e-3)
    assert flight.steepness > 1.9


def test_a_ground_kick_leaves_along_the_kick_axis_at_its_speed() -> None:
    """Equations 1 and 3 of the paper."""
    vx, vy, vz = kicked(KickMode.GROUND, 5.0, heading=2.0)
    assert (math.hypot(vx, vy), math.atan2(vy, vx), vz) == approx((5.0, 2.0, 0.0))


def test_a_lob_leaves_along_the_kick_axis() -> None:
    """Equation 10."""
    vx, vy, vz = kicked(KickMode.LOB, 8.0, x=4.0, heading=-0.1)
    assert math.atan2(vy, vx) == approx(-0.1) and vz > 0.0


@pytest.mark.parametrize("speed", [2.0, 7.0, 14.0])
def test_a_loft_kick_leaves_at_its_speed_and_angle_and_needs_no_goal(speed: float) -> None:
    """As in simatch: 36.87°, 0.8 of the speed along the ground and 0.6 upward."""
    vx, vy, vz = kicked(KickMode.LOFT, speed, heading=math.pi / 2)
    assert (vx, vy, vz) == approx((0.0, 0.8 * speed, 0.6 * speed), abs=1e-9)


def test_no_kick_is_faster_than_the_device() -> None:
    """simatch does not clamp the strength of a lob."""
    assert kicked(KickMode.GROUND, 40.0).vx == approx(MSL.kicker.max_ground_speed)
    assert math.hypot(*kicked(KickMode.LOFT, 40.0)) == approx(MSL.kicker.max_air_speed)
    far = kicked(KickMode.LOB, 40.0, x=-3.0)
    assert far.vx == approx(MSL.kicker.max_lob_speed)
    assert math.hypot(*far) <= MSL.kicker.max_air_speed


@pytest.mark.parametrize(("x", "heading", "d"), [(0, 0, 11), (3, math.pi, 14), (5, math.pi / 4, 6 * math.sqrt(2))])
def test_the_distance_is_measured_along_the_kick_axis_to_the_goal_line_ahead(
    x: float, heading: float, d: float
) -> None:
    assert distance_to_goal_plane(x, heading, MSL.field.goal_line) == approx(d)


def test_a_lob_that_meets_no_goal_line_is_refused_with_its_reason() -> None:
    with pytest.raises(KickRefusedError, match="aimed at a goal"):
        kicked(KickMode.LOB, 8.0, heading=math.pi / 2)


def test_a_lob_beyond_the_devices_power_is_refused_with_its_reason() -> None:
    with pytest.raises(KickRefusedError, match=r"reaches the goal, 31\.1 m away, with at most 20 m/s"):
        kicked(KickMode.LOB, 12.0, x=-11.0, heading=math.pi / 4)


def test_a_lob_that_needs_more_speed_than_the_kicker_has_is_refused() -> None:
    """A lob over 8 m takes about 9 m/s."""
    needed = math.hypot(*kicked(KickMode.LOB, 6.0, x=3.0))
    for most, is_refused in ((needed - 0.01, True), (needed + 0.01, False)):
        profile = replace(MSL, kicker=replace(MSL.kicker, max_air_speed=most))
        with pytest.raises(KickRefusedError, match="with at most") if is_refused else nullcontext():
            kicked(KickMode.LOB, 6.0, profile, x=3.0)


def test_modes_have_names() -> None:
    """In the NuBot simulation −1 and +1 meant ground and lob, and in simatch lob and ground."""
    assert {mode.value for mode in KickMode} == {"ground", "lob", "loft"}
    with pytest.raises(ValueError, match="-1"):
        KickMode(-1)
