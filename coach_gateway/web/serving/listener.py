"""The socket that the page is served on, and its address for a browser."""

import socket

from coach_gateway.timing import UNREAD_S
from schemas.errors import TouchlineError

_ROOM_BYTES = 65_536
"""Bytes that the kernel buffers for a page that has not read them yet: about ten frames. Its default holds hundreds."""
_HERE = {"0.0.0.0": "127.0.0.1", "::": "::1"}
"""Wildcard address → the loopback address that a browser on this machine can use."""


def listen(address: str, port: int) -> socket.socket:
    """A listening socket; a connection is cut when its other side has not read for `UNREAD_S`.

    Raises:
        TouchlineError: the port cannot be listened on.
    """
    family = socket.AF_INET6 if ":" in address else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)  # without it, asyncio leaves Nagle's delay
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _ROOM_BYTES)
    if hasattr(socket, "TCP_USER_TIMEOUT"):
        listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, round(UNREAD_S * 1000))
    try:
        listener.bind((address, port))
        listener.listen()  # a browser that connects before the server serves is not turned away
    except (OSError, OverflowError) as error:
        listener.close()
        why = error.strerror if isinstance(error, OSError) else "a port is 0 to 65535"
        raise TouchlineError(
            f"the page cannot be served on {address} port {port} ({why}); choose another port, or 0 for a free one"
        ) from None
    return listener


def origin_of(address: str, port: int) -> str:
    """The origin of what is served there, for a browser on this machine."""
    near = _HERE.get(address, address)
    return f"http://[{near}]:{port}" if ":" in near else f"http://{near}:{port}"
