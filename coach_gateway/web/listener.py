"""The socket that the page is served on, and the address of it that a browser is given."""

import socket

from coach_gateway.web.pages import STUCK_S
from schemas.bus.endpoint import reserve_port
from schemas.errors import TouchlineError

_ROOM_BYTES = 65_536
"""What the kernel keeps for a page that has not read it yet: some ten frames; of itself it would keep hundreds."""
_HERE = {"0.0.0.0": "127.0.0.1", "::": "::1"}
"""Every address → the one of this machine that a browser on it can use."""


def listen(address: str, port: int) -> socket.socket:
    """A socket that listens; what it accepts is cut when the other side has not read for long.

    Raises:
        TouchlineError: it cannot be had.
    """
    family = socket.AF_INET6 if ":" in address else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _ROOM_BYTES)
    if hasattr(socket, "TCP_USER_TIMEOUT"):
        listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, round(2 * STUCK_S * 1000))
    try:
        listener.bind((address, port))
        listener.listen()  # who comes before the server serves is not turned away
    except (OSError, OverflowError) as error:
        listener.close()
        why = error.strerror if isinstance(error, OSError) else "a port is 0 to 65535"
        raise TouchlineError(
            f"the page cannot be served on {address} port {port} ({why}); choose another port, or 0 for a free one"
        ) from None
    return listener


def free_port(address: str, port: int) -> int:
    """The port itself once it is sure that it can be listened on; a free one, given to nobody else, in place of 0.

    Raises:
        TouchlineError: it cannot.
    """
    listen(address, port).close()
    return port or reserve_port(address)


def origin_of(address: str, port: int) -> str:
    """Where a browser on this machine finds what is served there."""
    near = _HERE.get(address, address)
    return f"http://[{near}]:{port}" if ":" in near else f"http://{near}:{port}"
