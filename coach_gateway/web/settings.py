"""How the page is served: where, to whom, with which tokens."""

import importlib.util
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from coach_gateway.ports import LOOPBACK
from schemas.errors import TouchlineError

DEFAULT_PORT = 8080
DEFAULT_PAGES = 300
DEFAULT_PAGES_EACH = 100
"""Three classrooms behind one address; a third of the room."""


class BeliefsFor(StrEnum):
    """Who is shown what robots believe; the referee always is, and a coach is shown its own side's."""

    ALL = "all"
    TEAMS = "teams"


@dataclass(frozen=True, slots=True)
class WebSettings:
    """What whoever runs the gateway may choose."""

    port: int = DEFAULT_PORT
    """0 takes a free one."""
    listen: str = LOOPBACK
    """Address to listen on."""
    tokens: Path | None = None
    """File with the tokens, made when it is not there; without one they last as long as the process."""
    origins: tuple[str, ...] = ()
    """Further origins that the page may come from, `https://cup.example.org`."""
    beliefs: BeliefsFor | None = None
    """Without a word: for all in a friendly and in a replay, otherwise for the teams."""
    pages: int = DEFAULT_PAGES
    """How many pages may be open at once."""
    pages_each: int = DEFAULT_PAGES_EACH
    """How many of them from one address; those of this machine are not counted."""


def need_web() -> None:
    """Make sure that a page can be served by this installation.

    Raises:
        TouchlineError: with the line that brings what is missing.
    """
    if any(importlib.util.find_spec(name) is None for name in ("starlette", "uvicorn", "websockets")):
        raise TouchlineError("the page needs starlette, uvicorn and websockets; pip install 'touchline[coach]'")
