"""How the page is served: address, access, tokens, limits."""

from enum import StrEnum
from typing import Annotated

from pydantic import Field

from coach_gateway.ports import LOOPBACK
from runtime.process.installed import need
from schemas.config.settings import Settings

DEFAULT_PORT = 8080
DEFAULT_PAGES = 300


class BeliefsFor(StrEnum):
    """Which pages are shown what robots believe. The referee always is, and a coach for its own side."""

    ALL = "all"
    TEAMS = "teams"


class WebSettings(Settings):
    """How the page is served."""

    port: Annotated[int, Field(ge=0, le=65_535)] = DEFAULT_PORT
    """Port of the page; 0 selects a free one."""
    listen_web: str = LOOPBACK
    """Address to serve the page on; 0.0.0.0 lets other machines see it."""
    allow_origin: list[str] = Field(default_factory=list)
    """A further origin that the page may come from: https://cup.example.org."""
    beliefs: BeliefsFor | None = None
    """The roles that are shown beliefs; by default all in a friendly and in a replay, otherwise each team its own."""
    pages: Annotated[int, Field(ge=1)] = DEFAULT_PAGES
    """Number of pages that may be open at the same time; one with a token is admitted beyond it."""


def need_web() -> None:
    """Make sure that a page can be served by this installation.

    Raises:
        TouchlineError: a package is missing; the message has the line that installs it.
    """
    need("the page needs starlette, uvicorn and websockets", "coach", "starlette", "uvicorn", "websockets")
