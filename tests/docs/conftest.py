"""Where the documents are, the fenced pieces in them, and the scripts that make parts of them."""

import importlib
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import pytest


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
def generator(root: Path) -> Iterator[Callable[[str], ModuleType]]:
    """Imports a script of docs/generate by its name."""
    before = list(sys.path)
    sys.path.insert(0, str(root / "docs" / "generate"))
    yield importlib.import_module
    sys.path[:] = before
