"""How the page is served: where, and to whom."""

import importlib.util
from enum import StrEnum
from typing import Annotated

from pydantic import Field

from schemas.config.settings import Settings
from schemas.errors import TouchlineError

DEFAULT_PORT = 8080
LOOPBACK = "127.0.0.1"
DEFAULT_PAGES = 300
DEFAULT_PAGES_EACH = 100
"""Three classrooms behind one address; a third of the room."""


class BeliefsFor(StrEnum):
    """Who is shown what robots believe; the referee always is, and a coach is shown its own side's."""

    ALL = "all"
    TEAMS = "teams"


class WebSettings(Settings):
    """How the page is served."""

    port: Annotated[int, Field(ge=0, le=65_535)] = DEFAULT_PORT
    """Port of the page; 0 takes a free one."""
    listen_web: str = LOOPBACK
    """Address to serve the page on; 0.0.0.0 lets other machines see it."""
    allow_origin: list[str] = Field(default_factory=list)
    """A further origin that the page may come from: https://cup.example.org."""
    beliefs: BeliefsFor | None = None
    """Who is shown what robots believe; by default all in a friendly and in a replay, else each team its own."""
    pages: Annotated[int, Field(ge=1)] = DEFAULT_PAGES
    """Number of pages that may be open at once."""
    pages_per_address: Annotated[int, Field(ge=1)] = DEFAULT_PAGES_EACH
    """Number of them from one other address; those of this machine are not counted."""


def need_web() -> None:
    """Make sure that a page can be served by this installation.

    Raises:
        TouchlineError: with the line that brings what is missing.
    """
    if any(importlib.util.find_spec(name) is None for name in ("starlette", "uvicorn", "websockets")):
        raise TouchlineError("the page needs starlette, uvicorn and websockets; pip install 'touchline[coach]'")
