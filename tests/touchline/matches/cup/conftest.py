"""A cup of three matches of two seconds, played once."""

from contextlib import closing
from pathlib import Path

import pytest

from support.cups import mini_cup, play


@pytest.fixture(scope="session")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a cup that was played by one worker; its results are in the folder `out` there."""
    folder = tmp_path_factory.mktemp("cup")
    with closing(mini_cup(folder)) as run:
        state = play(run, 1)
    assert state.is_complete
    return folder
