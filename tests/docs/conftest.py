"""Where the documents are, the fenced pieces in them, and the scripts that make parts of them."""

import importlib
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from schemas.config.match_config import MatchConfig
from schemas.soccer.game import EventKind
from sim_host.match.simulation import TickResult
from touchline.play.play_match import play_match


@pytest.fixture(scope="session")
def root() -> Path:
    return Path(__file__).parents[2]


@pytest.fixture(scope="session")
def fenced() -> Callable[[str, str], list[str]]:
    """The fenced pieces of one language in a Markdown text."""

    def pieces(text: str, language: str) -> list[str]:
        every = re.findall(r"^```(\w*)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
        return [piece for its_language, piece in every if its_language == language]

    return pieces


@pytest.fixture(scope="session")
def carry_and_shot() -> Callable[..., tuple[float, float]]:
    """Plays a match whose cyan1 takes the kick-off: how far it carries the ball along x, and where it kicks first."""

    def played(config: MatchConfig, until: float, **more: Any) -> tuple[float, float]:
        held: list[float] = []
        kicks: list[float] = []

        def watch(tick: TickResult) -> None:
            x = tick.world["robots"]["cyan1"]["x"]
            if tick.world["possession"] == "cyan1":
                held.append(x)
            if tick.applied["inputs"]["cyan1"].kick is not None and not tick.refused.get("cyan1", 0):
                kicks.append(x)

        events = play_match(config, watch=watch, until=until, **more).events
        assert next(event for event in events if event.kind is EventKind.IN_PLAY).robot == "cyan1"
        return max(held) - min(held), kicks[0]

    return played


@pytest.fixture(scope="session")
def generator(root: Path) -> Iterator[Callable[[str], ModuleType]]:
    """Imports a script of docs/generate by its name."""
    before = list(sys.path)
    sys.path.insert(0, str(root / "docs" / "generate"))
    yield importlib.import_module
    sys.path[:] = before
