"""The pytest plugin: the fixture `play`. It imports nothing of this library before a test uses it."""

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from touchline.testing.scene_player import ScenePlayer


@pytest.fixture
def play(request: pytest.FixtureRequest) -> "ScenePlayer":
    """Plays a scene in this process, and returns what happened in it.

    Example: facts = play("one_against_keeper", cyan2="my_team:Striker", seconds=6, seed=3)
    """
    from touchline.testing.scene_player import ScenePlayer

    return ScenePlayer(request.path.parent)
