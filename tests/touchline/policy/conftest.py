"""A match of rovers in one process, for what its robots observe and do."""

from collections.abc import Iterator
from pathlib import Path

import pytest

import touchline.tasks
from schemas.config.match_config import load_match
from support.imports import forgotten_imports
from support.rover_task import write_rover_task
from touchline.play.play_match import InProcessMatch


@pytest.fixture
def rovers(tmp_path: Path) -> Iterator[InProcessMatch]:
    """The match, at tick 1, perceived without noise."""
    config = load_match(Path(write_rover_task(tmp_path)), {"noise.preset": "perfect"})
    with forgotten_imports(tmp_path):
        match = InProcessMatch(config, brain_folder=tmp_path)
        match.step()
        yield match
        match.close()


@pytest.fixture
def keepers() -> Iterator[InProcessMatch]:
    """A match of keepaway at tick 0, perceived without noise."""
    file = Path(touchline.tasks.__path__[0]) / "keepaway_3v2.toml"
    match = InProcessMatch(load_match(file, {"noise.preset": "perfect"}), brain_folder=file.parent)
    yield match
    match.close()
