"""The league's schema of a world state, written from MSLWMD of RefBox and from nothing of ours."""

import math
from collections.abc import Callable
from typing import Any

import pytest

NUMBER = (int, float)


def _check(state: Any) -> None:
    """Fail where the schema does not hold: required keys, their types, lengths and ranges."""
    assert isinstance(state, dict)
    assert {"type", "teamName", "intention", "robots", "balls", "obstacles", "ageMs"} <= set(state)
    assert state["type"] == "worldstate"
    assert isinstance(state["teamName"], str) and isinstance(state["intention"], str)
    assert _is_number(state["ageMs"]) and state["ageMs"] >= 0
    for robot in state["robots"]:
        assert isinstance(robot["id"], int)
        for key in ("pose", "targetPose", "velocity"):
            _vector(robot[key], 3)
        assert isinstance(robot["intention"], str)
        assert _is_number(robot["batteryLevel"]) and 0 <= robot["batteryLevel"] <= 100
        assert robot["ballEngaged"] in (0, 1) and not isinstance(robot["ballEngaged"], bool)
    for ball in state["balls"]:
        _vector(ball["position"], 3)
        _vector(ball["velocity"], 3)
        assert 0 <= ball["confidence"] <= 1
    for obstacle in state["obstacles"]:
        _vector(obstacle["position"], 2)
        _vector(obstacle["velocity"], 2)
        assert _is_number(obstacle["radius"]) and obstacle["radius"] > 0
        assert 0 <= obstacle["confidence"] <= 1


def _vector(value: Any, length: int) -> None:
    assert isinstance(value, list) and len(value) == length and all(_is_number(one) for one in value), value


def _is_number(value: Any) -> bool:
    return isinstance(value, NUMBER) and not isinstance(value, bool) and math.isfinite(value)


@pytest.fixture(scope="session")
def check_world_state() -> Callable[[Any], None]:
    """Fails where an object is not as the league's schema asks."""
    return _check
