"""A coach's order is consistent, or refused with the reason."""

import math
from typing import Any

import pytest

from schemas.messages.coach import REQUIRED_FIELDS, CoachMode, CoachOrder, CoachTest
from schemas.soccer.game import Point
from schemas.wire.faults import FaultError

WHOLE: dict[str, Any] = {
    "robot_a": "cyan2",
    "robot_b": "cyan3",
    "point_a": Point(x=2.0, y=1.0),
    "point_b": Point(x=4.0, y=-1.0),
    "radius": 1.5,
}


def refused(**content: Any) -> str:
    with pytest.raises(FaultError) as error:
        CoachOrder(sequence=1, **content)
    return error.value.fault.sentence()


def test_every_test_has_its_needs_written_down() -> None:
    assert list(REQUIRED_FIELDS) == list(CoachTest)
    assert {name for needs in REQUIRED_FIELDS.values() for name in needs} <= set(CoachOrder.__struct_fields__)


@pytest.mark.parametrize("test", CoachTest)
def test_a_test_that_has_what_it_needs_is_an_order(test: CoachTest) -> None:
    content = {name: WHOLE[name] for name in REQUIRED_FIELDS[test]}
    order = CoachOrder(sequence=1, mode=CoachMode.TEST, test=test, **content)
    assert CoachOrder.decode(order.encode()) == order


@pytest.mark.parametrize(("test", "need"), [(test, need) for test, needs in REQUIRED_FIELDS.items() for need in needs])
def test_a_test_without_what_it_needs_is_refused_by_name(test: CoachTest, need: str) -> None:
    content = {name: value for name, value in WHOLE.items() if name != need}
    assert refused(mode=CoachMode.TEST, test=test, **content) == f"the test {test.value} needs {need}"


def test_the_mode_test_names_a_test_and_no_other_mode_does() -> None:
    assert "the mode test needs a test, one of stop, move" in refused(mode=CoachMode.TEST)
    assert refused(mode=CoachMode.HOLD, test=CoachTest.STOP) == "the mode hold has no test; leave out stop"


def test_a_pass_is_between_two_robots() -> None:
    content = {**WHOLE, "robot_b": "cyan2"}
    assert "needs two robots, and both are cyan2" in refused(mode="test", test="pass", **content)


@pytest.mark.parametrize(
    ("field", "value", "reason"),
    [
        ("point_a", {"x": 450.0, "y": 0.0}, "farther than 100 m"),
        ("angle_a", 90.0, "angle_a is 90.0"),
        ("radius", 0.0, "radius is 0.0"),
        ("kick_speed", 41.0, "kick_speed is 41.0"),
        ("max_speed", math.inf, "max_speed is inf"),
        ("max_turn_rate", -1.0, "max_turn_rate is -1.0"),
        ("test", "tset", "test is 'tset'"),
    ],
)
def test_centimetres_degrees_and_what_no_robot_can_do_are_refused(field: str, value: Any, reason: str) -> None:
    assert reason in refused(**{field: value})
