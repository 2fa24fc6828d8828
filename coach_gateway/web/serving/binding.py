"""What the page's server needs before there is a match: its socket and address, its tokens, the allowed origins."""

import socket
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from coach_gateway.access.origins import Origins
from coach_gateway.access.roles import TokenRole
from coach_gateway.access.tokens import Tokens, page_address
from coach_gateway.ports import bound_socket
from coach_gateway.timing import UNREAD_S
from coach_gateway.web.settings import WebSettings

_ROOM_BYTES = 65_536
"""Bytes that the kernel buffers for a page that has not read them yet: about ten frames. Its default holds hundreds."""
_HERE = {"0.0.0.0": "127.0.0.1", "::": "::1"}
"""Wildcard address → the loopback address that a browser on this machine can use."""


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


def listen(address: str, port: int) -> socket.socket:
    """A listening socket; a connection is cut when its other side has not read for `UNREAD_S`.

    A browser that connects before the server serves is not turned away.

    Raises:
        TouchlineError: the port cannot be listened on.
    """
    listener = bound_socket("the page's port", address, port, socket.SOCK_STREAM, "--listen-web")
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _ROOM_BYTES)
    if hasattr(socket, "TCP_USER_TIMEOUT"):
        listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, round(UNREAD_S * 1000))
    return listener


def origin_of(address: str, port: int) -> str:
    """The origin of what is served there, for a browser on this machine."""
    near = _HERE.get(address, address)
    return f"http://[{near}]:{port}" if ":" in near else f"http://{near}:{port}"
