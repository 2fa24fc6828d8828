"""How the page is served: address, access, tokens, limits."""

import importlib.util
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from coach_gateway.ports import LOOPBACK
from schemas.errors import TouchlineError

DEFAULT_PORT = 8080
DEFAULT_PAGES = 300
DEFAULT_PAGES_EACH = 100
"""Enough for three classrooms behind one address, and a third of all pages."""


class BeliefsFor(StrEnum):
    """Which pages are shown what robots believe. The referee always is, and a coach for its own side."""

    ALL = "all"
    TEAMS = "teams"


@dataclass(frozen=True, slots=True)
class WebSettings:
    """What the operator of the gateway may choose."""

    port: int = DEFAULT_PORT
    """0 takes a free one."""
    listen: str = LOOPBACK
    """Address to listen on."""
    tokens: Path | None = None
    """File of the tokens, created when missing; without one they last as long as the process."""
    origins: tuple[str, ...] = ()
    """Further origins of the page, `https://cup.example.org`."""
    beliefs: BeliefsFor | None = None
    """By default: all in a friendly and in a replay, otherwise teams."""
    pages: int = DEFAULT_PAGES
    """How many pages may be open at once."""
    pages_each: int = DEFAULT_PAGES_EACH
    """How many of them may come from one address; those of this machine are not counted."""


def need_web() -> None:
    """Make sure that a page can be served by this installation.

    Raises:
        TouchlineError: a package is missing; the message has the line that installs it.
    """
    if any(importlib.util.find_spec(name) is None for name in ("starlette", "uvicorn", "websockets")):
        raise TouchlineError("the page needs starlette, uvicorn and websockets; pip install 'touchline[coach]'")
