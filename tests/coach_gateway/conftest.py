"""A match for bridges: a fake host, or a real one that is stepped, on the in-process bus."""

from collections.abc import Callable
from typing import Any

import pytest

from support.gateway_bench import kicked_off, opened, until

Opened = Callable[..., Any]


@pytest.fixture(name="opened")
def _opened() -> Opened:
    return opened


@pytest.fixture(name="kicked_off")
def _kicked_off() -> Opened:
    return kicked_off


@pytest.fixture(name="until")
def _until() -> Callable[..., Any]:
    return until
