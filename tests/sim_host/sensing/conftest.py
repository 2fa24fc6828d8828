"""Worlds to perceive, and what is perceived of them by names instead of places."""

from collections.abc import Callable

import pytest

from support.scenery import Scenery


@pytest.fixture
def scenery() -> Callable[..., Scenery]:
    return Scenery
