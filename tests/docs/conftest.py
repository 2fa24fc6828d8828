"""Where the documents are, and the fenced pieces in them."""

import re
from collections.abc import Callable
from pathlib import Path

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
