"""Points of an order have to be on the field or its border, and a circle around them, too."""

import pytest

from schemas.config.profile import load_profile
from schemas.messages.coach import CoachMode, CoachOrder, CoachTest
from schemas.soccer.game import Point

PITCH = load_profile("msl").field
X, Y = PITCH.goal_line + PITCH.border, PITCH.touch_line + PITCH.border


def location(a: tuple[float, float], b: tuple[float, float] = (0.0, 0.0)) -> CoachOrder:
    points = {"point_a": Point(x=a[0], y=a[1]), "point_b": Point(x=b[0], y=b[1])}
    return CoachOrder(sequence=1, mode=CoachMode.TEST, test=CoachTest.LOCATION, robot_a="cyan1", **points)


def circle(x: float, radius: float) -> CoachOrder:
    place = Point(x=x, y=0.0)
    return CoachOrder(
        sequence=1, mode=CoachMode.TEST, test=CoachTest.CIRCLE, robot_a="cyan1", point_a=place, radius=radius
    )


@pytest.mark.parametrize("place", [(X, Y), (-X, Y), (0.0, -Y)])
def test_the_border_belongs_to_the_field(place: tuple[float, float]) -> None:
    assert location(place).refusal_on(PITCH) == "" and location((0.0, 0.0), place).refusal_on(PITCH) == ""


@pytest.mark.parametrize("place", [(X + 0.01, 0.0), (-X - 0.01, 0.0), (0.0, Y + 0.01), (50.0, 0.0)])
def test_a_point_beyond_it_is_refused_by_its_name(place: tuple[float, float]) -> None:
    assert location(place).refusal_on(PITCH).startswith(f"point_a at ({place[0]:g}, {place[1]:g}) is outside")
    assert location((0.0, 0.0), place).refusal_on(PITCH).startswith("point_b at")


def test_a_circle_that_leaves_the_field_is_refused() -> None:
    assert circle(5.0, 4.0).refusal_on(PITCH) == ""
    assert "a circle of 8 m around point_a at (5, 0) is outside" in circle(5.0, 8.0).refusal_on(PITCH)


def test_an_order_without_points_has_none_to_refuse() -> None:
    assert CoachOrder(sequence=1, mode=CoachMode.HOLD).refusal_on(PITCH) == ""
