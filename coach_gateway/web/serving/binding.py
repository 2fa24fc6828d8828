"""What the page's server needs before there is a match: its socket, its tokens, and the allowed origins."""

import socket
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from coach_gateway.access.origins import Origins
from coach_gateway.access.roles import TokenRole
from coach_gateway.access.tokens import Tokens, page_address
from coach_gateway.web.serving.listener import listen, origin_of
from coach_gateway.web.settings import WebSettings


@dataclass(frozen=True, slots=True)
class PageBinding:
    """A bound socket with its access rules. A browser that connects before the page is served waits in its backlog."""

    settings: WebSettings
    listener: socket.socket
    tokens: Tokens
    tokens_file: Path | None
    origins: Origins

    @property
    def origin(self) -> str:
        """The page's address for a browser on this machine."""
        return origin_of(*self.listener.getsockname()[:2])

    def lines(self) -> Iterator[str]:
        """The page's address, and the file of the tokens; without one, the address of each role with its token."""
        yield f"page: {self.origin}/"
        if self.tokens_file is not None:
            yield f"tokens: {self.tokens_file}"
            return
        for role in (TokenRole.REFEREE, TokenRole.CYAN, TokenRole.MAGENTA):
            yield f"{role.value}: {page_address(self.origin, self.tokens.of(role))}"


def bind_page(
    settings: WebSettings, tokens: Tokens, tokens_file: Path | None = None, listener: socket.socket | None = None
) -> PageBinding:
    """Listen on the page's port, unless there is a `listener` already; `tokens_file` holds the tokens, if a file does.

    Raises:
        TouchlineError: the port is taken, or an origin is invalid.
    """
    origins = Origins(settings.allow_origin)
    return PageBinding(settings, listener or listen(settings.listen_web, settings.port), tokens, tokens_file, origins)
