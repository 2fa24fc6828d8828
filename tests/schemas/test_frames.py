"""Frames: one set of axes, and ways between them that lead back."""

import math

from hypothesis import given
from hypothesis import strategies as st
from pytest import approx

from schemas.frames import Pose, rotate, to_body, wrap

ANGLE = st.floats(-20, 20)
METRES = st.floats(-50, 50)


@given(ANGLE)
def test_a_wrapped_angle_is_the_same_direction_within_half_a_turn(angle: float) -> None:
    wrapped = wrap(angle)
    assert -math.pi < wrapped <= math.pi
    assert math.cos(wrapped) == approx(math.cos(angle), abs=1e-9)
    assert math.sin(wrapped) == approx(math.sin(angle), abs=1e-9)


def test_straight_back_is_plus_pi_never_minus_pi() -> None:
    assert wrap(-math.pi) == math.pi
    assert wrap(3 * math.pi) == approx(math.pi)


@given(METRES, METRES, ANGLE)
def test_into_the_body_frame_and_back_changes_nothing(x: float, y: float, heading: float) -> None:
    assert rotate(*to_body(x, y, heading), heading) == approx((x, y), abs=1e-9)


def test_the_body_frame_has_x_ahead_and_y_to_the_left() -> None:
    assert to_body(0, 1, math.pi / 2) == approx((1, 0))
    assert to_body(-1, 0, math.pi / 2) == approx((0, 1))


@given(METRES, METRES, st.floats(-3, 3))
def test_the_team_frame_of_the_other_side_is_its_own_inverse(x: float, y: float, heading: float) -> None:
    there = Pose(x, y, heading).team(-1)
    back = there.team(-1)
    assert (there.x, there.y) == (-x, -y)
    assert (back.x, back.y, back.heading) == approx((x, y, heading), abs=1e-9)
