"""Ports that the gateway listens on: bound once, before there is a match, and kept until the process ends.

A launcher binds the ports of the programs that it launches. It reports a port that is in use at once, and passes the
bound sockets on, also to a program that is started again: no other process can take the port meanwhile.
"""

import errno
import os
import socket
from collections.abc import Sequence

from schemas.errors import TouchlineError

LOOPBACK = "127.0.0.1"
"""Address that only this machine can reach."""
INHERITED = "TOUCHLINE_SOCKETS"
"""Environment variable with the file descriptors of sockets that a launcher has bound, in the order of their use."""


class InheritedSockets:
    """The sockets that the launcher of this process has bound; none without a launcher."""

    def __init__(self) -> None:
        self._handles = [int(word) for word in os.environ.pop(INHERITED, "").split(",") if word]

    def next(self) -> socket.socket | None:
        """The next socket, or None if there is no further one."""
        if not self._handles:
            return None
        inherited = socket.socket(fileno=self._handles.pop(0))
        inherited.set_inheritable(False)
        return inherited


def inheritance_of(sockets: Sequence[socket.socket]) -> dict[str, str]:
    """The environment of a program that inherits these sockets."""
    return {INHERITED: ",".join(str(one.fileno()) for one in sockets)} if sockets else {}


def bound_socket(
    option: str, address: str, port: int, kind: socket.SocketKind, where: str = "--listen-bridges"
) -> socket.socket:
    """A socket on this port; one of a kind with connections listens. `where` is the option that has the address.

    Raises:
        TouchlineError: the port cannot be listened on.
    """
    try:
        found = socket.getaddrinfo(address, port, type=kind, flags=socket.AI_PASSIVE)
        family, _, protocol, _, place = min(found, key=lambda one: one[0] is not socket.AF_INET)  # of a name's several
        bound = socket.socket(family, kind, protocol)  # without the protocol, asyncio leaves Nagle's delay
    except (OSError, UnicodeError) as error:
        raise _cannot_listen(option, address, port, where, error) from None
    try:
        if kind is socket.SOCK_STREAM:
            bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # connections in TIME_WAIT do not count
        bound.bind(place)
        if kind is socket.SOCK_STREAM:
            bound.listen()
    except OSError as error:
        bound.close()
        raise _cannot_listen(option, address, port, where, error) from None
    return bound


def _cannot_listen(option: str, address: str, port: int, where: str, error: OSError | UnicodeError) -> TouchlineError:
    if isinstance(error, socket.gaierror | UnicodeError) or error.errno == errno.EADDRNOTAVAIL:
        return TouchlineError(f"{where} {address} is not an address of this machine; 0.0.0.0 is all of them")
    return TouchlineError(
        f"{option} {port} cannot be listened on at {address} ({error.strerror}); choose another port, or 0"
    )
