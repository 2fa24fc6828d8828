"""Ports that bridges listen on. They are tried before there is a match, so that a taken port is reported at once."""

import errno
import socket
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

from schemas.errors import TouchlineError

LOOPBACK = "127.0.0.1"
"""Address that only this machine can reach."""


@contextmanager
def port_tried(option: str, address: str, port: int, kind: socket.SocketKind) -> Iterator[None]:
    """Make sure that this port can be listened on, and release it at the end of the block.

    Raises:
        TouchlineError: the port cannot be listened on.
    """
    with ExitStack() as stack:
        try:
            family, _, _, _, place = socket.getaddrinfo(address, port, type=kind, flags=socket.AI_PASSIVE)[0]
            probe = stack.enter_context(socket.socket(family, kind))
            if kind is socket.SOCK_STREAM:
                probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # as the server itself does
            probe.bind(place)
            if kind is socket.SOCK_STREAM:
                probe.listen()
        except (OSError, UnicodeError) as error:
            raise cannot_listen(option, address, port, error) from None
        yield


def cannot_listen(option: str, address: str, port: int, error: OSError | UnicodeError) -> TouchlineError:
    """The error for a port that cannot be listened on."""
    if isinstance(error, socket.gaierror | UnicodeError) or error.errno == errno.EADDRNOTAVAIL:
        return TouchlineError(f"--listen-bridges {address} is not an address of this machine; 0.0.0.0 is all of them")
    return TouchlineError(
        f"{option} {port} cannot be listened on at {address} ({error.strerror}); choose another port, or 0"
    )
