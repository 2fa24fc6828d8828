"""Tests for brains: scenes played in the test's process, and what happened in them to assert on.

pytest finds the fixture `play` by itself where this library is installed. docs/testing.md explains it.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from touchline.testing.facts import Facts
    from touchline.testing.runs import Runs
    from touchline.testing.scene_player import ScenePlayer

_HOMES = {
    "Facts": "touchline.testing.facts",
    "Runs": "touchline.testing.runs",
    "ScenePlayer": "touchline.testing.scene_player",
}
"""Name → the module that defines it; imported when it is first used, because pytest imports this package always."""

__all__ = ["Facts", "Runs", "ScenePlayer"]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'touchline.testing' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
