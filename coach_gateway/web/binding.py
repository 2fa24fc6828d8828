"""What the page's server needs before there is any match: its socket, its tokens, and who may come in."""

import socket
from collections.abc import Iterator
from dataclasses import dataclass

from coach_gateway.access.origins import Origins
from coach_gateway.access.roles import Role
from coach_gateway.access.tokens import Tokens, page_address
from coach_gateway.web.listener import listen, origin_of
from coach_gateway.web.settings import WebSettings


@dataclass(frozen=True, slots=True)
class PageBinding:
    """A page that people can be told of: who comes before it is served waits a moment."""

    settings: WebSettings
    listener: socket.socket
    tokens: Tokens
    origins: Origins

    @property
    def origin(self) -> str:
        """Where a browser on this machine finds the page."""
        return origin_of(*self.listener.getsockname()[:2])

    def lines(self) -> Iterator[str]:
        """Where to find the page, and with which token: a log that others may read has none."""
        yield f"page: {self.origin}/"
        if self.settings.tokens is not None:
            yield f"tokens: {self.settings.tokens}"
            return
        for role in (Role.REFEREE, Role.CYAN, Role.MAGENTA):
            yield f"{role.value}: {page_address(self.origin, self.tokens.of(role))}"


def bind_page(settings: WebSettings, tokens: Tokens) -> PageBinding:
    """Listen.

    Raises:
        TouchlineError: the port is taken, an origin is none.
    """
    origins = Origins(settings.origins)
    return PageBinding(settings, listen(settings.listen, settings.port), tokens, origins)
