"""A match made by hand, tick by tick: four robots, ticks of 0.1 s, the ball in play from the second on."""

from collections.abc import Callable

import pytest

from support.match_script import MatchScript


@pytest.fixture
def script() -> MatchScript:
    return MatchScript()


@pytest.fixture
def new_script() -> Callable[[], MatchScript]:
    return MatchScript
